#pragma once
// run.json: what made the results that lie beside it.
#include <filesystem>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/points/run_options.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

// Writes `folder`/run.json: where the results come from (see origin), versions, models with
// provenance, what the files hold that the experiment names, why the run ended, the host's speed
// where it was measured; for each point how busy processors and links were, host times, events. The
// records of the points are in `folder` too, and are read one by one.
void save_run_json(const std::filesystem::path& folder, const RunOptions& options,
                   const Simulation& simulation);

}  // namespace laboratory
