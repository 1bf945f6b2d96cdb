#pragma once
// [data]: how the farm's workers share a scene that none of them holds.
#include "experiments/laboratory/file/binding.hpp"
#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

const std::vector<Binding<Experiment>>& data_bindings();

}  // namespace laboratory
