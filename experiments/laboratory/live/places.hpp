#pragma once
// Where the processors of a machine are drawn.
#include <vector>

#include "simulator/machine/machine.hpp"
#include "topologies/draw/layout.hpp"

namespace laboratory {

/// A place for every processor of the machine: those of the network as reports draw the topology,
/// the others beside a processor that a link joins them to. `network` has the ids of the network's
/// processors; empty: each has its number there.
topologies::Places place_processors(const machine::Machine& machine,
                                    const topologies::Topology& topology,
                                    const std::vector<int>& network);

}  // namespace laboratory
