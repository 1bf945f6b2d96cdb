// Loads an experiment from a text, as if it were a file e.toml.
#pragma once

#include <fstream>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/farm/program.hpp"
#include "tests/laboratory/support/support.hpp"

namespace laboratory {

inline Overrides parse_overrides(const std::vector<std::string>& texts) {
  Overrides overrides;
  for (const auto& text : texts) overrides.push_back(parse_override(text));
  return overrides;
}

inline ExperimentFile load(const std::string& text,
                           const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  const auto path = folder.path / "e.toml";
  std::ofstream(path) << text;
  return load_experiment(path.string(), parse_overrides(overrides));
}

inline std::vector<std::string> axes_of(const ExperimentFile& file) {
  std::vector<std::string> names;
  for (const auto& axis : file.axes()) names.push_back(axis.name);
  return names;
}

// The value of a parameter, and the same value as text for display.
inline base::Scalar get_value(const Experiment& e, const std::string& parameter) {
  return e.program->find(parameter)->get(e.params);
}
inline std::string show_value(const Experiment& e, const std::string& parameter) {
  return base::to_text(get_value(e, parameter));
}

// The farm's parameters, and the number of objects in its scene.
inline const farm::ProgramParams& farm_of(const Experiment& e) {
  return std::any_cast<const farm::ProgramParams&>(e.params);
}
inline std::int64_t objects_of(const Experiment& e) { return farm_of(e).scene.objects; }

}  // namespace laboratory
