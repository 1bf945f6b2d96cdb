#pragma once
// [[fault]], [[processor]], [let], [[check]], [[plot]], [[best]] and [report], as they stand in the
// file.
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/file/values.hpp"

namespace laboratory {

/// Reads all [[fault]], in order; none for an empty list. Throws BadInput, naming which and its
/// line, for unknown, missing or contradicting keys. What breaks is not known yet.
std::vector<FaultSpec> read_faults(const Place& at);
/// Reads all [[processor]] in the same way.
std::vector<OtherProcessor> read_others(const Place& at);

/// Reads [let], [[check]], [[plot]], [[best]] and [report] into `into`, which has its path and
/// folder. Throws BadInput for unknown, missing or contradicting keys; formulas are only texts yet.
void read_judgement(const toml::table& file, ExperimentFile& into);

/// The keys of these tables and of [model].
std::vector<Setting> table_settings();

}  // namespace laboratory
