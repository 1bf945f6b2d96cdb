#pragma once
// Random draw of machines from the ranges of their models' entries.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {

/// Draws the quantiles of an entry for all machines, above 0 and below 1. They form a Latin
/// hypercube: the range is divided into as many equal slices as there are machines, and each slice
/// has one of them. An entry's quantiles do not depend on other entries.
std::vector<double> draw_quantiles(std::uint64_t seed, const std::string& entry,
                                   std::size_t machines);

/// The number at a quantile of a range. It is uniform between low and high. For ranges given as
/// shares of the entry's value, the logarithm of the share is uniform.
double find_in(const machine::Range& range, double quantile);

/// Draws a machine, and returns the overrides of model entries that realise it: `set`, and a number
/// for each other entry with a range. Calls `quantile` for each of these entries. A calibrated
/// entry is first fitted again, so that its `holds` formula keeps its value despite the other drawn
/// numbers.
machine::Overrides draw_machine(const std::string& model, const machine::Overrides& set,
                                const std::function<double(const std::string& entry)>& quantile);

/// The entries drawn at random for at least one point of the file, in the order of the models.
std::vector<std::string> drawn_entries(const ExperimentFile& file);

/// Makes a file with the points of all randomly drawn machines: its own points, then those of
/// machine 1, 2, ... in the same order, on the engine "direct". Returns the file unchanged if it
/// draws none.
ExperimentFile spread(const ExperimentFile& file);

}  // namespace laboratory
