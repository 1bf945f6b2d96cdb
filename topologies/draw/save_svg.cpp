// SVG by the Graphviz programs.
#include "topologies/draw/graphviz.hpp"
#include "topologies/files/formats.hpp"

namespace topologies {

std::string to_svg(const Topology& topology) {
  const bool is_tree = static_cast<int>(topology.links.size()) == topology.processors - 1;
  return run_graphviz(is_tree ? "dot -Tsvg" : "neato -Tsvg", to_dot(topology), topology.name);
}

}  // namespace topologies
