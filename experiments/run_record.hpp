#pragma once
// run.json: what made the results that lie beside it.
#include <filesystem>

#include "experiments/experiment.hpp"
#include "experiments/run.hpp"
#include "experiments/simulation.hpp"

namespace experiments {

// "tlab run FILE --set ..."
std::string command_line(const RunOptions& options);

// Writes `folder`/run.json: where the results come from (see origin), versions, models with
// provenance, what the files hold that the experiment names, why the run ended, the host's speed
// where it was measured; for each point how busy processors and links were, host times, events. The
// records of the points are in `folder` too, and are read one by one.
void save_run_json(const std::filesystem::path& folder, const RunOptions& options,
                   const Simulation& simulation);

}  // namespace experiments
