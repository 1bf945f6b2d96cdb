#pragma once
// From an experiment to its folder of results.
#include <filesystem>

#include "experiments/check_plan.hpp"
#include "experiments/experiment.hpp"
#include "experiments/run.hpp"
#include "experiments/simulation.hpp"

namespace experiments {

// Where results go: as asked, or results/NAME.
std::filesystem::path results_folder(const RunOptions& options);

// Runs every point, evaluates the checks, and writes everything into the folder, all or nothing.
// Whether checks hold changes nothing here.
Simulation simulate(const RunOptions& options, const ExperimentFile& file, const CheckPlan& plan);

}  // namespace experiments
