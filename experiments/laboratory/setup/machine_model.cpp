#include "experiments/laboratory/setup/machine_model.hpp"

#include <fmt/format.h>

#include <set>

namespace laboratory {

namespace {

constexpr const char* ORIGIN = "[model]";

}  // namespace

machine::Model make_model(const Experiment& experiment) {
  if (experiment.model_overrides.empty()) return machine::load_model(experiment.model.path);
  return machine::override_model(experiment.model.path, experiment.model_overrides, ORIGIN);
}

std::string model_key(const Experiment& experiment) {
  std::string key = experiment.model.path;
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
