#pragma once
// Templates for an experiment, or for a program on a simulated machine.
#include <filesystem>
#include <string>
#include <vector>

namespace laboratory {

/// "farm", "topology", "radiosity", "program"
std::vector<std::string> template_names();

/// Makes the folder `name` with the files of a template, all of them or none. Files and their
/// contents are named by the last part of `name`. Returns the files' paths. Throws BadInput for an
/// unknown template, for a last part that is not a letter followed by up to 99 letters, digits, -
/// and _, for an existing `name` and for a missing parent; std::system_error if writing fails.
std::vector<std::filesystem::path> start_from_template(const std::filesystem::path& name,
                                                       const std::string& from);

}  // namespace laboratory
