#pragma once
// Parts of error messages: suggestions for unknown names, and printable forms of arbitrary input.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace base {

/// Makes a message that quotes arbitrary input safe to print. Control characters other than line
/// ends, characters that change the direction of text, and bytes that are not UTF-8, become escapes
/// such as "\x1b". Lines of more than 2000 bytes
/// are cut in the middle; the length of the cut is shown.
std::string make_readable(std::string_view message);

/// Escapes the bytes that make_readable escapes, except tabs, but does not cut lines.
std::string show_controls(std::string_view text);

/// The name in `known` with the smallest edit distance from `name`, if this distance is at most a
/// third of the length of the longer name, rounded up. Otherwise the nearest name that contains
/// `name` or is contained in it. None if there is no such name.
std::optional<std::string> find_similar(std::string_view name,
                                        const std::vector<std::string>& known);

/// The end of a message about an unknown name: `, PHRASE "NAME"` if find_similar finds a NAME,
/// otherwise ", expected one of ..." with all known names.
std::string suggest(std::string_view name, const std::vector<std::string>& known,
                    std::string_view phrase = "the nearest is");

/// Returns ` (did you mean "NAME"?)`, or "" if find_similar finds no name.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

/// The edit distance by optimal string alignment: the minimum number of edits that turn `a` into
/// `b`. An edit inserts, removes or changes a letter, or swaps two adjacent letters.
std::size_t count_edits(std::string_view a, std::string_view b);

}  // namespace base
