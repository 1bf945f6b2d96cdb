#pragma once
// Beginnings of one's own: an experiment, or a program on a simulated machine.
#include <filesystem>
#include <string>
#include <vector>

namespace laboratory {

/// "farm", "topology", "radiosity", "program"
std::vector<std::string> template_names();

/// Makes the folder `name` with the files of a template, in which everything is called by the last
/// part of `name`; all of it or nothing. Returns their paths. Throws BadInput for an unknown
/// template, for a last part that is not made of letters, digits, - and _, beginning with a letter,
/// and where something called `name` is there; std::system_error where nothing can be written.
std::vector<std::filesystem::path> start_from_template(const std::filesystem::path& name,
                                                       const std::string& from);

}  // namespace laboratory
