#include "experiments/laboratory/points/machine_model.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <set>

#include "base/errors.hpp"
#include "base/spelling.hpp"
#include "experiments/laboratory/host/files.hpp"

namespace laboratory {

namespace {

using base::BadInput;
using Entries = std::vector<std::pair<std::string, std::string>>;
namespace fs = std::filesystem;

constexpr const char* ORIGIN = "[model]";

}  // namespace

machine::Model make_model(const Experiment& experiment) {
  if (experiment.model_overrides.empty()) return machine::load_model(experiment.model);
  return machine::override_model(experiment.model, experiment.model_overrides, ORIGIN);
}

std::string model_key(const Experiment& experiment) {
  std::string key = experiment.model;
  for (const auto& [entry, value] : experiment.model_overrides)
    key += fmt::format("\n{} = {}", entry, value);
  return key;
}

std::vector<machine::Model> models_of(const ExperimentFile& file) {
  std::set<std::string> known;
  std::vector<machine::Model> models;
  for (const auto& point : file.points)
    if (known.insert(model_key(point.experiment)).second)
      models.push_back(make_model(point.experiment));
  return models;
}

}  // namespace laboratory
