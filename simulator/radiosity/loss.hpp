#pragma once
// Where the time of a run has gone.
#include <memory>

#include "simulator/radiosity/application.hpp"

namespace amp {

// Of all processors over `time_s`.
Loss eval_loss(const machine::Model& model, const radiosity::Mesh& mesh, const Params& params,
               const std::vector<std::unique_ptr<Application>>& applications, double time_s);

}  // namespace amp
