#pragma once
// A graph as a file tells it, before it is a topology. For the readers of this room, and for those
// who have a graph in another form than a file.

#include <string>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

struct RawVertex {
  std::string name;
  std::string root;  ///< text of attribute `root`, empty when absent
};

struct RawEdge {
  int source = 0, target = 0;  ///< indices of vertices
  std::string port_a, port_b;  ///< text of the attributes, empty when absent
};

struct RawGraph {
  std::vector<RawVertex> vertices;  ///< as first named in the file
  std::vector<RawEdge> edges;       ///< as in the file
  std::string root;                 ///< name of a vertex, empty when absent
  bool has_arrows = false;          ///< whether the graph is a directed one
};

/// Makes a topology by the rules of formats.hpp; it has passed `check`. Throws BadInput that begins
/// with `name`.
Topology make_topology(const RawGraph& graph, const std::string& name);

/// What a file calls the processors: their labels, else their numbers.
std::vector<std::string> names_of(const Topology& topology);

}  // namespace topologies
