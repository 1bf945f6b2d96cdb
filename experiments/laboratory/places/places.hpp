#pragma once
// Positions of a machine's processors in drawings.
#include <optional>
#include <vector>

#include "simulator/machine/machine.hpp"
#include "topologies/draw/layout.hpp"

namespace laboratory {

/// By processor of the machine; some have no place yet.
using SomePlaces = std::vector<std::optional<topologies::Place>>;

/// The machine's id of a network processor, looked up in `network`; empty: the same number.
int find_id(const std::vector<int>& network, int processor);

/// Gives the remaining processors places beside others that they share a link or memory with;
/// isolated ones form a row.
topologies::Places place_others(const machine::Machine& machine, SomePlaces places);

/// A place for every processor of the machine. The network is placed as reports draw the topology,
/// others beside a processor with a link to them. `network` maps network processors to ids in the
/// machine; empty: equal numbers.
topologies::Places place_processors(const machine::Machine& machine,
                                    const topologies::Topology& topology,
                                    const std::vector<int>& network);

}  // namespace laboratory
