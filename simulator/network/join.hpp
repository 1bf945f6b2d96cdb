#pragma once
// Makes a machine's links from a topology.
#include <array>
#include <vector>

#include "simulator/machine/machine.hpp"
#include "topologies/graph/topology.hpp"

namespace network {

/// The directions of a link: from its end a to its end b, and from b to a.
using Directions = std::array<machine::LinkDirection*, 2>;

/// Links the processors, which must not have links yet. `at(i)` returns the machine's processor for
/// processor i of the topology. Returns both directions of each link, by index into
/// Topology::links.
std::vector<Directions> join(machine::Machine& machine, const topologies::Topology& topology,
                             auto at) {
  std::vector<Directions> all;
  std::size_t number = 0;  // number of earlier links between the same two processors
  for (std::size_t i = 0; i < topology.links.size(); ++i) {
    const auto& [a, b] = topology.links[i];
    const bool again = i > 0 && topology.links[i - 1].a.processor == a.processor &&
                       topology.links[i - 1].b.processor == b.processor;
    number = again ? number + 1 : 0;
    machine::Processor &here = at(a.processor), &there = at(b.processor);
    machine.connect(here, there, switches_between(topology, a.processor, b.processor));
    all.push_back({&machine.link(here, there, number), &machine.link(there, here, number)});
  }
  return all;
}

}  // namespace network
