#pragma once
// Declares every key of the experiment file and the field that it sets. All functions throw
// BadInput with the file and the line or key.

#include "base/toml.hpp"
#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// The programs that the points of a file run: those on the axis "program", or the only one, which
/// the key program.name selects.
using Programs = std::vector<const programs::Program*>;
Programs programs_in_play(const toml::table& file, const std::vector<Coupled>& sweep,
                          const std::string& origin);

/// Lists the programs that use a feature, for error messages: "farm, iirra".
std::string list_users(bool programs::Uses::*of);

/// Sets the fields of all keys in `file.keys`. Then sets the fields of the axes to their values in
/// `at`. Ignores keys of other programs in `in_play`. Throws for an unknown key, with the nearest
/// valid key, and for a value of the wrong kind.
Experiment bind_settings(const ExperimentFile& file, const std::vector<Coordinate>& at,
                         const Programs& in_play);

/// Throws if a parameter names a missing file, or if a required file name is empty.
void check_files(const Experiment& experiment);

/// Finds the key that an axis sets: the key `name`, or the key that ends with it. Examples of
/// `name` are "workers", "network.workers", a parameter of a program in `in_play`, "program" and
/// "model.link.one_way_rate". Throws with the nearest valid name.
Axis name_axis(const std::string& name, const Programs& in_play, const std::string& origin);

/// Splits "workers, height" into names, without quotes and surrounding blanks.
std::vector<std::string> split_names(std::string_view name);

}  // namespace laboratory
