#pragma once
// Machines drawn from what the numbers of their models may be.
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/machine/model.hpp"

namespace laboratory {

/// The quantiles, above 0 and below 1, that the machines have of an entry: a Latin hypercube, so
/// that every machine has another of as many equal slices. They depend on nothing else: entries
/// that are added change no others.
std::vector<double> draw_quantiles(std::uint64_t seed, const std::string& entry,
                                   std::size_t machines);

/// The number at a quantile: even between low and high, or, where they are shares of the value,
/// even in their logarithm; the share then.
double find_in(const machine::Range& range, double quantile);

/// What an experiment sets in its model so that it becomes the machine with these quantiles:
/// entries with a range, but for those that `set` names, and calibrated ones that are fitted again,
/// so that what each holds stays as it is.
/// `quantile` is asked for each entry that is drawn.
using Entries = std::vector<std::pair<std::string, std::string>>;
Entries draw_machine(const std::string& model, const Entries& set,
                     const std::function<double(const std::string& entry)>& quantile);

/// The entries that are drawn at some point of the file, in the order of the models.
std::vector<std::string> drawn_entries(const ExperimentFile& file);

/// The file's points, and behind them those of machine 1, 2, ... in the same order, on the engine
/// "direct"; the file itself if it draws none.
ExperimentFile spread(const ExperimentFile& file);

}  // namespace laboratory
