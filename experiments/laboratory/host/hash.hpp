#pragma once
// Content hash of files and records.
#include <string>
#include <string_view>

namespace laboratory {

/// The 128-bit hash XXH3 as 32 hexadecimal digits, the same on every host. Equal hashes are taken
/// as equal content.
std::string hash_of(std::string_view bytes);

}  // namespace laboratory
