#pragma once
// An unchecked graph as read from a file, before it becomes a topology. Readers of files use it,
// and callers with a graph in another form.

#include <string>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

struct RawVertex {
  std::string name;
  std::string root;  ///< text of attribute `root`, "" without one
};

struct RawEdge {
  int source = 0, target = 0;  ///< indices of vertices
  std::string port_a, port_b;  ///< text of the attributes, "" without one
};

struct RawGraph {
  std::vector<RawVertex> vertices;  ///< in the order of first mention in the file
  std::vector<RawEdge> edges;       ///< in the file's order
  std::string root;                 ///< name of a vertex, or ""
  bool has_arrows = false;          ///< the graph is directed
};

/// Makes a topology by the rules of formats.hpp; it has passed `check`. Throws BadInput; messages
/// begin with `name`.
Topology make_topology(const RawGraph& graph, const std::string& name);

/// The processors' names in a file: their labels, else their numbers.
std::vector<std::string> names_of(const Topology& topology);

}  // namespace topologies
