// An experiment from its text, as if it stood in a file e.toml.
#pragma once

#include <fstream>

#include "experiments/laboratory/file/experiment.hpp"
#include "tests/laboratory/support/support.hpp"

namespace laboratory {

inline ExperimentFile load(const std::string& text,
                           const std::vector<std::string>& overrides = {}) {
  const TemporaryFolder folder;
  const auto path = folder.path / "e.toml";
  std::ofstream(path) << text;
  return load_experiment(path.string(), overrides);
}

}  // namespace laboratory
