// The farm's network, every processor and link coloured by its load.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/report/report.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

struct NetworkDrawings {
  std::vector<Report::Drawing> drawings;  ///< with the most workers, in both cases: for the report
  std::vector<std::string> failures;      ///< of points that could not be drawn, and why
  std::vector<std::string> notes;         ///< of points that are too large for the report
};

/// Writes networks/NAME.svg into `folder`, which holds the points' records, as [report] networks
/// asks: for every point ("all"), or for those with the most workers among points that are alike
/// otherwise ("largest"). Only the farm has such drawings. The report has none of more than 1024
/// workers; of more than topologies::MAX_DRAWN there is no file either. Up to RunOptions::jobs are
/// drawn at the same time.
NetworkDrawings draw_networks(const std::filesystem::path& folder, const RunOptions& options,
                              const Simulation& s);

}  // namespace laboratory
