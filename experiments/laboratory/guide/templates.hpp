#pragma once
// Templates for `tlab init`: an experiment, or a program on a simulated machine.
#include <filesystem>
#include <string>
#include <vector>

namespace laboratory {

/// The names of all templates: "farm", "topology", "radiosity" and "program".
std::vector<std::string> template_names();

/// Makes the folder `name` with the files of the template `from`, all of them or none. The last
/// part of the path `name` is used in the names and contents of the files. It must be a letter
/// followed by at most 99 letters, digits, - and _. Returns the paths of the files. Throws BadInput
/// for an unknown template, an invalid or existing `name`, or a missing parent folder. Throws
/// std::system_error if writing fails.
std::vector<std::filesystem::path> start_from_template(const std::filesystem::path& name,
                                                       const std::string& from);

}  // namespace laboratory
