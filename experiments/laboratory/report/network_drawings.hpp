// The farm's network, every processor and link coloured by its load.
#pragma once

#include <filesystem>
#include <vector>

#include "experiments/laboratory/report/report.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

/// Writes networks/NAME.svg into `folder`, which holds the points' records, as [report] networks
/// asks: for every point ("all"), or for those with the most workers among points that are alike
/// otherwise ("largest"). Returns the drawings of the latter in both cases, for the report. Only
/// the farm has such drawings.
std::vector<Report::Drawing> draw_networks(const std::filesystem::path& folder,
                                           const Simulation& s);

}  // namespace laboratory
