#pragma once
// From an experiment to its folder of results.
#include <filesystem>

#include "experiments/laboratory/command/run.hpp"
#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

// What to do about points whose records are not there.
enum class Missing { run, refuse };

// Runs every point that is missing, evaluates the checks, and writes everything into the folder,
// all or nothing; only the records of points are there as soon as they are done. Whether checks
// hold changes nothing here, nor do points that failed unless all have. Throws
// base::BadInput for results of another experiment, and for what is missing if that is
// refused.
Simulation simulate(const RunOptions& options, const ExperimentFile& file, const CheckPlan& plan,
                    Missing missing = Missing::run);

}  // namespace laboratory
