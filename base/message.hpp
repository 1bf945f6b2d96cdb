#pragma once
// Parts of error messages: suggestions for unknown names, and readable forms of any bytes.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace base {

/// Makes a message that quotes arbitrary input safe to print. Control characters other than line
/// ends, and bytes that are not UTF-8, become escapes such as "\x1b". Lines of more than 2000 bytes
/// lose their middle; its length is shown in its place.
std::string make_readable(std::string_view message);

/// The nearest name among `known` if at most a third of the letters, rounded up, differ; else the
/// nearest of the names that contain `name` or are contained in it.
std::optional<std::string> find_similar(std::string_view name,
                                        const std::vector<std::string>& known);

/// The end of a message: ", PHRASE "NAME"" with a similar name, or else ", expected one of ...".
std::string suggest(std::string_view name, const std::vector<std::string>& known,
                    std::string_view phrase = "the nearest is");

/// " (did you mean "NAME"?)", or "" if no name is similar.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

/// The edit distance: letters to insert, remove or change, and neighbouring letters to swap
/// (optimal string alignment).
std::size_t count_edits(std::string_view a, std::string_view b);

}  // namespace base
