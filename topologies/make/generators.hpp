#pragma once
// Generators of regular topologies. Each one is a function from sizes to a topology. The root is
// processor 0; its port 0 stays free unless the topology needs all four ports.

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

// All generators throw BadInput if a size is out of range or if there would be more than
// MAX_PROCESSORS processors. Drawings with ports are in generators.cpp.
Topology make_line(int n);                 ///< n >= 1
Topology make_ring(int n);                 ///< n >= 3
Topology make_tree(int n, int arity = 3);  ///< n >= 1, arity 1..3; thesis, figure 4.21
Topology make_binary(int n);  ///< a tree with at most two children per processor: make_tree(n, 2)
Topology make_mesh(int rows, int columns);   ///< rows, columns >= 1
Topology make_torus(int rows, int columns);  ///< rows, columns >= 1; a row of two has one link
Topology make_hypercube(int dimensions);     ///< dimensions in 0..4
Topology make_star(int n);                   ///< a centre and n - 1 leaves, n in 1..5

struct Generator {
  std::string form;  ///< the name, then its sizes, such as "mesh:RxC"
  std::string help;  ///< one line that describes the topology and the range of its sizes
  std::function<Topology(const std::vector<int>& sizes)> make;

  std::string name() const { return form.substr(0, form.find(':')); }
};

/// All generators, in the order used by the help text.
const std::vector<Generator>& generators();

/// Makes a topology from its specification: a generator ("tree:7", "mesh:4x4") or the path of a
/// .dot, .gv or .graphml file (formats.hpp). The result passes `check`. Throws BadInput.
Topology make_topology(std::string_view spec);

}  // namespace topologies
