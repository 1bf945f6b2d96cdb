#pragma once
// File names in the statements of text files.

#include <optional>
#include <string>
#include <string_view>

namespace renderer {

/// Cuts a text at a '#' between blanks. Any other '#' is part of a name, such as `Material #25`.
std::string_view cut_comment(std::string_view text);

/// Finds the file that `text`, the rest of a line, names relative to the folder of the file `name`.
/// The text may have quotes around it, backslashes for slashes, and a comment at its end. Returns
/// none if no such file exists.
std::optional<std::string> find_beside(const std::string& name, std::string_view text);

}  // namespace renderer
