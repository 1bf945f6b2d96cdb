#pragma once
// Where the processors of a machine are drawn.
#include <optional>
#include <vector>

#include "simulator/machine/machine.hpp"
#include "topologies/draw/layout.hpp"

namespace laboratory {

/// By processor of the machine; some have no place yet.
using SomePlaces = std::vector<std::optional<topologies::Place>>;

/// The id in the machine of a processor of the network, whose ids are `network`; empty: the same.
int find_id(const std::vector<int>& network, int processor);

/// Gives the other processors places beside those that a link or their memory joins them to; those
/// that nothing joins to any are in a row.
topologies::Places place_others(const machine::Machine& machine, SomePlaces places);

/// A place for every processor of the machine: those of the network as reports draw the topology,
/// the others beside a processor that a link joins them to. `network` has the ids of the network's
/// processors; empty: each has its number there.
topologies::Places place_processors(const machine::Machine& machine,
                                    const topologies::Topology& topology,
                                    const std::vector<int>& network);

}  // namespace laboratory
