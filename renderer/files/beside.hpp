#pragma once
// File names in text files: finds the files that a statement names.

#include <optional>
#include <string>
#include <string_view>

namespace renderer {

/// Cuts off the comment at the end of a text. It starts at a '#' with blanks on both sides. Any
/// other '#' is part of a name, such as `Material #25`.
std::string_view cut_comment(std::string_view text);

/// Finds the file named by `text`, the rest of a statement's line. The path is relative to the
/// folder of the file `name`. The text may be in quotes, use backslashes instead of slashes, and
/// end with a comment. Returns none if no such file exists.
std::optional<std::string> find_beside(const std::string& name, std::string_view text);

}  // namespace renderer
