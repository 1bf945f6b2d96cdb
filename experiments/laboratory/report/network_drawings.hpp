// Drawings of the farm's network with every processor and link coloured by its load.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/report/report.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

struct NetworkDrawings {
  /// drawings in the report: only points with the most workers
  std::vector<Report::Drawing> drawings;
  std::vector<std::string> failures;  ///< points that could not be drawn, with reasons
  std::vector<std::string> notes;     ///< points that are too large for the report
};

/// Writes networks/NAME.svg into `folder`, which holds the points' records. [report] networks
/// selects the points: "all", or "largest" for those with the most workers among otherwise equal
/// points. Only the farm has such drawings. The report shows networks of up to 1024 workers; files
/// are written up to topologies::MAX_DRAWN workers. Draws up to RunOptions::jobs points in
/// parallel.
NetworkDrawings draw_networks(const std::filesystem::path& folder, const RunOptions& options,
                              const Simulation& s);

}  // namespace laboratory
