#pragma once
// Long texts on a terminal.
#include <string>

namespace laboratory {

/// Prints a text; where standard output is a terminal, through the pager that PAGER names, "less"
/// by default, which leaves a text that fits as it is. A pager that fails is done without.
void print_paged(const std::string& text);

}  // namespace laboratory
