#pragma once
// Hash of the content of a file or record.
#include <string>
#include <string_view>

namespace laboratory {

/// The 128-bit hash XXH3 as 32 hexadecimal digits, the same on every host. Contents with equal
/// hashes are treated as equal.
std::string hash_of(std::string_view bytes);

}  // namespace laboratory
