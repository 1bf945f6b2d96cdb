#pragma once
// Messages on their way to people.
#include <string>
#include <string_view>

namespace base {

/// A message that may repeat any bytes of an input: control characters other than line ends, which
/// would command a terminal, and bytes that are no UTF-8 become "\x1b"; of more than 2000 bytes the
/// middle is left out, and it says how much.
std::string make_readable(std::string_view message);

}  // namespace base
