// A graph as a file tells it, before it is a topology. For the readers of this room only.
#pragma once

#include <string>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

struct RawVertex {
  std::string name;
  std::string root;  // text of attribute `root`, empty when absent
};

struct RawEdge {
  int source = 0, target = 0;  // indices of vertices
  std::string port_a, port_b;  // text of the attributes, empty when absent
};

struct RawGraph {
  std::vector<RawVertex> vertices;  // as first named in the file
  std::vector<RawEdge> edges;       // as in the file
  std::string root;                 // name of a vertex, empty when absent
};

// By the rules of formats.hpp; the result has passed `check`. Throws BadInput.
Topology make_topology(const RawGraph& graph, const std::string& name);

[[noreturn]] void fail_reading(const std::string& file, const std::string& what);

}  // namespace topologies
