#pragma once
// Beginnings of one's own: an experiment, or a program on a simulated machine.
#include <filesystem>
#include <string>
#include <vector>

namespace laboratory {

/// "farm", "topology", "radiosity", "program"
std::vector<std::string> template_names();

/// Makes the folder `name` with the files of a template, all of them or none; the files, and what
/// is in them, are called by the last part of `name`. Returns the files' paths. Throws BadInput for
/// an unknown template, for a last part that is no word of at most 100 letters, digits, - and _
/// that begins with a letter, where something called `name` is there, and where its parent is not;
/// std::system_error where nothing can be written.
std::vector<std::filesystem::path> start_from_template(const std::filesystem::path& name,
                                                       const std::string& from);

}  // namespace laboratory
