#pragma once
// The farm's network, every processor and link coloured by its load.
#include <filesystem>

#include "experiments/laboratory/report/report.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

// As [report] networks asks: writes networks/NAME.svg for every point of the farm ("all"), or for
// those with the most workers among points that otherwise are alike ("largest"). Returns the
// largest, for the report. `folder` has the points' records.
std::vector<ReportDrawing> draw_networks(const std::filesystem::path& folder, const Simulation& s);

}  // namespace laboratory
