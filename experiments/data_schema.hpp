#pragma once
// [data]: how the farm's workers share a scene that none of them holds.
#include "experiments/binding.hpp"
#include "experiments/experiment.hpp"

namespace experiments {

const std::vector<Binding<Experiment>>& data_bindings();

}  // namespace experiments
