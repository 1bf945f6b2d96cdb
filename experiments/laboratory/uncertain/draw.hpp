#pragma once
// Draws machines at random from the ranges of their models' entries.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {

/// Draws the quantiles of an entry, one for each machine, above 0 and below 1. They form a Latin
/// hypercube: the range is divided into as many equal slices as there are machines, and no two
/// machines get the same slice. The quantiles of an entry do not depend on other entries.
std::vector<double> draw_quantiles(std::uint64_t seed, const std::string& entry,
                                   std::size_t machines);

/// The number at a quantile of a range. Numbers are uniform between low and high, or uniform in
/// their logarithm if the range is given as shares of the entry's value.
double find_in(const machine::Range& range, double quantile);

/// Draws a machine. Returns the overrides of model entries that realise it: those in `set`, and a
/// drawn value for each other entry with a range. Calls `quantile` for each of these other entries.
/// A calibrated entry is first fitted again, so that its formula `holds` keeps its value although
/// other entries have changed.
machine::Overrides draw_machine(const std::string& model, const machine::Overrides& set,
                                const std::function<double(const std::string& entry)>& quantile);

/// The entries that are drawn at random for at least one point of the file, in the order of the
/// models.
std::vector<std::string> drawn_entries(const ExperimentFile& file);

/// Makes a file with the points for all randomly drawn machines: first the file's own points, then
/// the same points for machine 1, 2, and so on, simulated by the engine "direct". Returns the file
/// unchanged if it draws no machines.
ExperimentFile spread(const ExperimentFile& file);

}  // namespace laboratory
