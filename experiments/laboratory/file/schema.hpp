#pragma once
// Each key of the experiment file is declared once, bound to the field it sets. All throw BadInput
// with the file and line or key.
#include <toml++/toml.h>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// The programs that the points of a file run: program.name, or the values of the axis "program".
using Programs = std::vector<const programs::Program*>;
Programs programs_in_play(const toml::table& file, const std::string& origin);

/// The names of all programs that have a use for something, for an error: "farm, iirra".
std::string list_users(bool programs::Uses::*of);

/// A value that takes the place of a key's own.
struct Replacement {
  std::string key;
  const toml::node* value;
};

/// Sets every field that `file` names, then the replacements; paths are relative to `folder`. A key
/// of another program in play is passed over. Throws for an unknown key, with the nearest, and for
/// a value of the wrong kind.
Experiment bind_settings(const toml::table& file, const std::vector<Replacement>& replacements,
                         const Programs& in_play, const std::string& origin,
                         const std::string& folder);

/// Throws for a parameter that names a file which is not there, or none where one is required.
void check_files(const Experiment& experiment);

/// An axis of [sweep].
struct Axis {
  std::string name;  ///< of its column
  std::string key;   ///< that it replaces
  std::vector<const toml::node*> values;
};

/// The axis with a key that is, or ends with, `name`: "workers", "network.workers", a parameter of
/// a program in play, "program", "model.link.one_way_rate". Throws with the nearest.
Axis name_axis(const std::string& name, const Programs& in_play, const std::string& origin);

/// The names of "workers, height", without quotes and blanks around them.
std::vector<std::string> split_names(std::string_view name);

}  // namespace laboratory
