#pragma once
// The only content hash of the program.
#include <string>
#include <string_view>

namespace laboratory {

/// 128 bits (XXH3) as 32 hexadecimal digits, the same on every machine; equal hashes imply equal
/// bytes.
std::string hash_of(std::string_view bytes);

}  // namespace laboratory
