#pragma once
// Output of long texts on a terminal.
#include <string>

namespace laboratory {

/// Prints a text, on a terminal through the pager in PAGER, by default "less" with settings that
/// print short texts directly. Prints without a pager if that fails.
void print_paged(const std::string& text);

}  // namespace laboratory
