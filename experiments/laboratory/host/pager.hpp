#pragma once
// Output of long texts on a terminal.
#include <string>

namespace laboratory {

/// Prints a text, on a terminal through the pager named in PAGER. The default is "less", set to
/// print short texts directly. Prints without a pager if that fails.
void print_paged(const std::string& text);

}  // namespace laboratory
