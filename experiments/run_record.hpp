#pragma once
// run.json: what made the results that lie beside it.
#include <filesystem>
#include <optional>

#include "experiments/experiment.hpp"
#include "experiments/run.hpp"
#include "experiments/simulation.hpp"

namespace experiments {

// "tlab run FILE --set ..."
std::string command_line(const RunOptions& options);

// The experiment as resolved, versions, models with provenance, what the files hold that it names,
// why the run ended, the host's speed where it was measured, how busy processors and links were,
// host times, events.
std::string make_run_json(const RunOptions& options, const Simulation& simulation);

// The table of a folder of results, if this program would write the same: its run.json has the
// same experiment (checks aside), version, models and files, and is not older than the program.
std::optional<Table> find_results(const std::filesystem::path& folder, const ExperimentFile& file);

}  // namespace experiments
