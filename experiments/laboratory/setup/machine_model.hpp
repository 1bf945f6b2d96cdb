#pragma once
// The machine model of a point: a model by name, with the numbers that the experiment changes.
#include <filesystem>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {

// Throws base::BadInput for an unknown model or entry, with the nearest.
machine::Model make_model(const Experiment& experiment);

// The models that some point runs on, each once, in the order of the points.
std::vector<machine::Model> models_of(const ExperimentFile& file);

// What tells a model from others: its name, and what has been changed.
std::string model_key(const Experiment& experiment);

}  // namespace laboratory
