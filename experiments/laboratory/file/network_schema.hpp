#pragma once
// [[fault]], and the links of a tree in [network], as they stand in the file.
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/file/values.hpp"

namespace laboratory {

// [[a, b], ...]; none for an empty list. What they join is not known yet.
topologies::TreeLinks read_tree_links(const Place& at);

// All [[fault]], in order; none for an empty list. Throws base::BadInput, naming which and
// its line, for unknown, missing or contradicting keys. What breaks is not known yet.
std::vector<FaultSpec> read_faults(const Place& at);
const std::vector<Setting>& fault_settings();

}  // namespace laboratory
