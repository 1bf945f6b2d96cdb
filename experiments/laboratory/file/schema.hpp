#pragma once
// Each key of the experiment file is declared once, bound to the field it sets.
#include <toml++/toml.h>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

// The programs that the points of a file run: program.name, or the values of the axis "program".
using Programs = std::vector<const programs::Program*>;
// Throws base::BadInput for an unknown program, with the nearest.
Programs programs_in_play(const toml::table& file, const std::string& origin);

// A value that takes the place of a key's own.
struct Replacement {
  std::string key;
  const toml::node* value;
};

// Sets every field that `file` names, then the replacements; `folder` is what paths are relative
// to. A key of another program in play is passed over. Throws base::BadInput for an unknown key or
// a value of the wrong kind, with `origin` and line.
Experiment bind_settings(const toml::table& file, const std::vector<Replacement>& replacements,
                         const Programs& in_play, const std::string& origin,
                         const std::string& folder);

// Throws base::BadInput for a parameter that names a file which is not there, or none where one is
// required.
void check_files(const Experiment& experiment);

// An axis of [sweep].
struct Axis {
  std::string name;  // of its column
  std::string key;   // that it replaces
  std::vector<const toml::node*> values;
};

// The axis whose key is, or ends with, `name`: "workers", "network.workers", a parameter of a
// program in play, "program", "model.link.one_way_rate". Throws base::BadInput with the nearest.
Axis name_axis(const std::string& name, const Programs& in_play, const std::string& origin);

// The names of "workers, height", without quotes and blanks around them.
std::vector<std::string> split_names(std::string_view name);

// [[check]], in order, and [let]; `folder` is what the paths of references are relative to. Throw
// base::BadInput for unknown, missing or contradicting keys; formulas are only texts yet.
std::vector<Check> read_checks(const toml::table& file, const std::string& origin,
                               const std::string& folder);
std::vector<Definition> read_definitions(const toml::table& file, const std::string& origin);
const std::vector<Setting>& check_settings();

// [[plot]], [[best]] and [report], as above.
std::vector<PlotSpec> read_plots(const toml::table& file, const std::string& origin,
                                 const std::string& folder);
std::vector<BestSpec> read_bests(const toml::table& file, const std::string& origin);
ReportSpec read_report(const toml::table& file, const std::string& origin);
const std::vector<Setting>& figure_settings();

}  // namespace laboratory
