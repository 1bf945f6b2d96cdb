#pragma once
// Reads the tables [[fault]], [[processor]], [let], [[check]], [[plot]], [[best]] and [report] of a
// file.
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/file/values.hpp"

namespace laboratory {

/// Reads every [[fault]], in order; an empty list yields none. Throws BadInput with number and line
/// for unknown, missing or contradicting keys. The broken parts are looked up later.
std::vector<FaultSpec> read_faults(const Place& at);
/// Does the same for every [[processor]].
std::vector<OtherProcessor> read_others(const Place& at);

/// Reads [let], [[check]], [[plot]], [[best]] and [report] into `into`, which has its path and
/// folder. Throws BadInput for unknown, missing or contradicting keys; formulas remain texts here.
void read_judgement(const toml::table& file, ExperimentFile& into);

/// The keys of these tables and of [model].
std::vector<Setting> table_settings();

}  // namespace laboratory
