#pragma once
// Positions of a machine's processors in drawings. The unit is the usual distance of two
// neighbours.
#include <optional>
#include <vector>

#include "simulator/machine/machine.hpp"
#include "topologies/draw/layout.hpp"

namespace laboratory {

/// Positions of processors, by machine id; no value: not placed yet.
using SomePlaces = std::vector<std::optional<topologies::Place>>;

/// The machine id of a processor of the network. `network` lists the ids by number in the network;
/// if it is empty, the numbers are the ids.
int find_id(const std::vector<int>& network, int processor);

/// Places each processor without a position next to a processor with which it shares a link or
/// memory. Processors without such a neighbour form a row.
topologies::Places place_others(const machine::Machine& machine, SomePlaces places);

/// Positions of all processors of the machine, by id. The network is laid out as in reports. Every
/// other processor is next to a processor to which it has a link. `network` gives the machine id of
/// each processor of the network; if it is empty, the numbers are the ids.
topologies::Places place_processors(const machine::Machine& machine,
                                    const topologies::Topology& topology,
                                    const std::vector<int>& network);

}  // namespace laboratory
