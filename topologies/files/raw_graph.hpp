#pragma once
// A graph as read from a file, not yet checked. make_topology checks it and makes a topology.

#include <string>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

struct RawVertex {
  std::string name;
  std::string root;  ///< text of the attribute `root`, or "" if it is missing
  int line = 0;      ///< line in the file, counted from 1; 0 if unknown
};

struct RawEdge {
  int source = 0, target = 0;  ///< indices into `vertices`
  std::string port_a, port_b;  ///< text of the port attributes, or "" if missing
  /// The port's name in Graphviz or GraphML, such as "3", "3:n", "ne" or "f0"; "" if missing.
  std::string name_a = {}, name_b = {};
  int line = 0;  ///< line in the file, counted from 1; 0 if unknown
};

struct RawGraph {
  std::vector<RawVertex> vertices;  ///< in the order of first mention in the file
  std::vector<RawEdge> edges;       ///< in the file's order
  std::string root;                 ///< name of the root vertex, or ""
  bool has_arrows = false;          ///< the file's graph is directed
};

/// Makes a topology by the rules of load_topology in formats.hpp. The result passes `check`. Throws
/// BadInput; messages start with `name`.
Topology make_topology(const RawGraph& graph, const std::string& name);

/// The names of processors in files: their labels, or their numbers if the topology has no labels.
std::vector<std::string> names_of(const Topology& topology);

}  // namespace topologies
