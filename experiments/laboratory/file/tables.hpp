#pragma once
// Readers of the tables [[fault]], [[processor]], [let], [[check]], [[plot]], [[best]] and
// [report].
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/file/values.hpp"

namespace laboratory {

/// The largest number of a processor; processors are numbered from 0.
inline constexpr int LAST_PROCESSOR = topologies::MAX_PROCESSORS - 1;

/// Reads every [[fault]], in the order of the file. An empty list is valid. Throws BadInput with
/// the table's number and line for unknown, missing or contradictory keys. Does not check whether
/// the links and processors exist; the network is not known yet.
std::vector<FaultSpec> read_faults(const Place& at);
/// Reads every [[processor]], in the order of the file. Throws BadInput as read_faults() does. Does
/// not check whether the processors exist.
std::vector<OtherProcessor> read_others(const Place& at);

/// Reads [let], [[check]], [[plot]], [[best]] and [report] into `into`, whose path and folder must
/// be set. Throws BadInput for unknown, missing or contradictory keys. Does not parse formulas.
void read_judgement(const toml::table& file, ExperimentFile& into);

/// The keys of the tables in this file and of [model], for help texts.
std::vector<Setting> table_settings();

}  // namespace laboratory
