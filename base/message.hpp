#pragma once
// Parts of error messages: suggestions for unknown names, and printable forms of arbitrary input.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace base {

/// Makes a message that quotes arbitrary input safe to print. Control characters other than line
/// ends, and bytes that are not UTF-8, become escapes such as "\x1b". Lines of more than 2000 bytes
/// are cut in the middle; the length of the cut is shown.
std::string make_readable(std::string_view message);

/// Escapes control characters other than line ends and tabs, and bytes that are not UTF-8, as
/// make_readable does. Cuts nothing.
std::string show_controls(std::string_view text);

/// The nearest name among `known` if at most a third of its letters, rounded up, differ. Otherwise
/// the nearest name that contains `name` or is contained in it.
std::optional<std::string> find_similar(std::string_view name,
                                        const std::vector<std::string>& known);

/// Makes the end of a message about an unknown name: `, PHRASE "NAME"` if a known name is similar,
/// otherwise ", expected one of ...".
std::string suggest(std::string_view name, const std::vector<std::string>& known,
                    std::string_view phrase = "the nearest is");

/// " (did you mean "NAME"?)", or "" if no name is similar.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

/// The edit distance by optimal string alignment: the number of letters inserted, removed or
/// changed, and of adjacent letters swapped.
std::size_t count_edits(std::string_view a, std::string_view b);

}  // namespace base
