#pragma once
// What a run leaves beside its table: the settings that made it, and the report for people.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/experiment.hpp"
#include "experiments/run.hpp"
#include "experiments/table.hpp"

namespace experiments {

// run.json: the experiment as resolved, versions, model with provenance, host times, events.
std::string make_run_json(const RunOptions& options, const ExperimentFile& file, const Table& table,
                          const std::vector<nlohmann::ordered_json>& results, double wall_s);

// plots/*.svg, plots/*.png and report.html.
void write_report(const std::filesystem::path& folder, const RunOptions& options,
                  const ExperimentFile& file, const Table& table,
                  const std::vector<nlohmann::ordered_json>& results,
                  const std::vector<std::string>& images);

// The columns of the printed table: the axes, and what answers most questions.
std::vector<std::string> shown_columns(const Table& table);

}  // namespace experiments
