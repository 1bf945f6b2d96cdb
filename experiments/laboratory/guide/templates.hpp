#pragma once
// Templates for an experiment, or for a program on a simulated machine.
#include <filesystem>
#include <string>
#include <vector>

namespace laboratory {

/// "farm", "topology", "radiosity", "program"
std::vector<std::string> template_names();

/// Makes the folder `name` with the files of a template, all of them or none. Files and their
/// contents are named by the last part of `name`, a letter followed by at most 99 letters, digits,
/// - and _. Returns the files' paths. Throws BadInput for an unknown template, another form of the
/// last part, an existing `name` and a missing parent; std::system_error if writing fails.
std::vector<std::filesystem::path> start_from_template(const std::filesystem::path& name,
                                                       const std::string& from);

}  // namespace laboratory
