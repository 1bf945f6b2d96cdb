#pragma once
// The report of a run for people.
#include <filesystem>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/points/run_options.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

// plots/*.svg, plots/*.png and report.html.
void write_report(const std::filesystem::path& folder, const RunOptions& options,
                  const Simulation& simulation);

// The experiment's, or its file's name.
std::string title_of(const ExperimentFile& file);

// The columns of the printed table: of the farm the axes, and what answers most questions.
std::vector<std::string> shown_columns(const ExperimentFile& file, const Table& table);

}  // namespace laboratory
