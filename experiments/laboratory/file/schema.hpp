#pragma once
// Declares each key of the experiment file once, bound to its field. All functions throw BadInput
// with the file and line or key.
#include <toml++/toml.h>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// The programs that the file's points run: program.name, or the values of the axis "program".
using Programs = std::vector<const programs::Program*>;
Programs programs_in_play(const toml::table& file, const std::string& origin);

/// The names of all programs that use a feature, for an error: "farm, iirra".
std::string list_users(bool programs::Uses::*of);

/// A value that overrides a key.
struct Replacement {
  std::string key;
  const toml::node* value;
};

/// Sets every field that `file` names, then the replacements; paths are relative to `folder`. Skips
/// keys that belong to another program in play. Throws for an unknown key, with the nearest, and
/// for a value of the wrong kind.
Experiment bind_settings(const toml::table& file, const std::vector<Replacement>& replacements,
                         const Programs& in_play, const std::string& origin,
                         const std::string& folder);

/// Throws for a parameter that names a missing file, or none if a file is required.
void check_files(const Experiment& experiment);

/// An axis of [sweep].
struct Axis {
  std::string name;  ///< of its column
  std::string key;   ///< the key that it replaces
  std::vector<const toml::node*> values;
};

/// Finds the axis whose key is `name` or ends with it: "workers", "network.workers", a parameter of
/// a program in play, "program", "model.link.one_way_rate". Throws with the nearest.
Axis name_axis(const std::string& name, const Programs& in_play, const std::string& origin);

/// The names in "workers, height", without quotes and surrounding blanks.
std::vector<std::string> split_names(std::string_view name);

}  // namespace laboratory
