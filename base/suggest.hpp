#pragma once
// What a message offers in the place of a name that is not known.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace base {

/// The nearest name among `known` if it is similar, a third of the letters or fewer being others;
/// else the nearest of those that contain `name` or are contained in it.
std::optional<std::string> find_similar(std::string_view name,
                                        const std::vector<std::string>& known);

/// The end of a message: ", PHRASE "NAME"" with the similar name, or else ", expected one of ...".
std::string suggest(std::string_view name, const std::vector<std::string>& known,
                    std::string_view phrase = "the nearest is");

/// " (did you mean "NAME"?)", or nothing where no name is similar.
std::string did_you_mean(std::string_view name, const std::vector<std::string>& known);

/// The number of letters to insert, remove or change to make one of the other (Levenshtein).
std::size_t count_edits(std::string_view a, std::string_view b);

}  // namespace base
