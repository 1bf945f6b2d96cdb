// Names that were mistyped.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace base {

// The name among `known` (not empty) that takes the fewest edits from `name` (Levenshtein's
// distance); of several the first.
std::string nearest_name(std::string_view name, const std::vector<std::string>& known);

}  // namespace base
