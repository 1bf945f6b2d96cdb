// Drawings of a program's network, in which the colour of processors and links shows their loads.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/report/report.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

struct NetworkDrawings {
  /// drawings for the report; only of points with the most workers
  std::vector<Report::Drawing> drawings;
  std::vector<std::string> failures;  ///< points that could not be drawn, with the reasons
  /// notes about points whose networks are too large for the report
  std::vector<std::string> notes;
};

/// Writes networks/NAME.svg into `folder`, which holds the records of the points. The key
/// `networks` of [report] selects the points: "all", or "largest" for the point with the most
/// workers among points that are otherwise equal. Only some programs, such as the farm, declare
/// drawings of networks. The report shows networks of up to 1024 workers; files are written for up
/// to topologies::MAX_DRAWN workers. Draws up to RunOptions::jobs points at the same time.
NetworkDrawings draw_networks(const std::filesystem::path& folder, const RunOptions& options,
                              const Simulation& s);

}  // namespace laboratory
