#pragma once
// Positions of a machine's processors in drawings.
#include <optional>
#include <vector>

#include "simulator/machine/machine.hpp"
#include "topologies/draw/layout.hpp"

namespace laboratory {

/// Positions by machine processor; none: not yet placed.
using SomePlaces = std::vector<std::optional<topologies::Place>>;

/// The machine id of a network processor, looked up in `network`. If `network` is empty, the id is
/// the processor's number.
int find_id(const std::vector<int>& network, int processor);

/// Places the remaining processors next to those that they share a link or memory with. Isolated
/// processors form a row.
topologies::Places place_others(const machine::Machine& machine, SomePlaces places);

/// Positions of all processors of the machine. The network is laid out as in reports, and all other
/// processors are next to one that they have a link to. `network` maps network processors to
/// machine ids; if it is empty, the numbers equal the ids.
topologies::Places place_processors(const machine::Machine& machine,
                                    const topologies::Topology& topology,
                                    const std::vector<int>& network);

}  // namespace laboratory
