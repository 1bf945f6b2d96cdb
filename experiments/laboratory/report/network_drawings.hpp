// Drawings of the farm's network with every processor and link coloured by its load.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/report/report.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

struct NetworkDrawings {
  std::vector<Report::Drawing> drawings;  ///< for the report: only points with the most workers
  std::vector<std::string> failures;      ///< points that could not be drawn, and the reasons
  std::vector<std::string> notes;         ///< points that are too large for the report
};

/// Writes networks/NAME.svg into `folder`, which holds the points' records, as [report] networks
/// requests: for every point ("all"), or for points with the most workers among otherwise equal
/// ones ("largest"). Only the farm has such drawings. The report shows none of more than 1024
/// workers; above topologies::MAX_DRAWN workers there is no file either. Draws up to
/// RunOptions::jobs in parallel.
NetworkDrawings draw_networks(const std::filesystem::path& folder, const RunOptions& options,
                              const Simulation& s);

}  // namespace laboratory
