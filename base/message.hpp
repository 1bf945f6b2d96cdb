#pragma once
// What messages say: names in the place of unknown ones, and any bytes so that people can read
// them.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace base {

/// A message that may repeat any bytes of an input: control characters other than line ends, which
/// would command a terminal, and bytes that are no UTF-8 become "\x1b"; of each line of more than
/// 2000 bytes the middle is left out, and it says how much.
std::string make_readable(std::string_view message);

/// The nearest name among `known` if it is similar, a third of the letters, rounded up, or
/// fewer being others; else the nearest of those that contain `name` or are contained in it.
std::optional<std::string> find_similar(std::string_view name,
                                        const std::vector<std::string>& known);

/// The end of a message: ", PHRASE "NAME"" with the similar name, or else ", expected one of ...".
std::string suggest(std::string_view name, const std::vector<std::string>& known,
                    std::string_view phrase = "the nearest is");

/// " (did you mean "NAME"?)", or nothing where no name is similar.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

/// The number of letters to insert, remove or change, and of neighbours to swap, to make one of the
/// other (optimal string alignment).
std::size_t count_edits(std::string_view a, std::string_view b);

}  // namespace base
