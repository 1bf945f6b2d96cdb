#pragma once
// The points of an experiment: checked together, run side by side, each in a process of its own.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/check_plan.hpp"
#include "experiments/experiment.hpp"
#include "experiments/run.hpp"

namespace experiments {

// Rejects what is wrong in any point, or in options that speak of points, before the first one
// runs.
void check_points(const RunOptions& options, const ExperimentFile& file);

// What came out of each point, see farm_run and pattern_run; null for those that were not started,
// where the user interrupted. `images`: of each point the file to save in `folder`, or "".
std::vector<nlohmann::ordered_json> run_points(const RunOptions& options,
                                               const ExperimentFile& file, const CheckPlan& plan,
                                               const std::filesystem::path& folder,
                                               const std::vector<std::string>& images);

// Whether a point came to its end.
bool is_complete(const nlohmann::ordered_json& result);
// Why the run ended: a sentence. `points` were to be run.
std::string describe_end(const std::vector<nlohmann::ordered_json>& results, std::size_t points);

}  // namespace experiments
