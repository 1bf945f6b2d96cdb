#pragma once
#include <string>

namespace laboratory {

/// Prints a text; where standard output is a terminal, through the pager that PAGER names, "less"
/// by default, which leaves a text that fits as it is.
void print_paged(const std::string& text);

}  // namespace laboratory
