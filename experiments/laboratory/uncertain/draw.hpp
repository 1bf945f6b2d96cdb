#pragma once
// Machines drawn at random from the ranges of their models' entries.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {

/// The machines' quantiles of an entry, above 0 and below 1: a Latin hypercube, with one machine in
/// each of equally many slices. They depend on nothing else: additional entries change no others.
std::vector<double> draw_quantiles(std::uint64_t seed, const std::string& entry,
                                   std::size_t machines);

/// The number at a quantile: uniform between low and high; for ranges given as shares of the value,
/// the share, uniform in its logarithm.
double find_in(const machine::Range& range, double quantile);

/// The entries that turn the model into the machine with these quantiles: `set`, and a draw for
/// each other entry with a range. Before its draw, a calibrated entry is fitted again so that its
/// `holds` formula keeps its value. `quantile` is called for each drawn entry.
using Entries = std::vector<std::pair<std::string, std::string>>;
Entries draw_machine(const std::string& model, const Entries& set,
                     const std::function<double(const std::string& entry)>& quantile);

/// The entries that are drawn at some point of the file, in the order of the models.
std::vector<std::string> drawn_entries(const ExperimentFile& file);

/// The file's points, followed by those of machine 1, 2, ... in the same order, on the engine
/// "direct"; the file itself if it draws none.
ExperimentFile spread(const ExperimentFile& file);

}  // namespace laboratory
