#include "topologies/draw/graphviz.hpp"

#include "base/host_program.hpp"
#include "topologies/files/dot.hpp"

namespace topologies {

std::string run_graphviz(const std::string& program, const std::vector<std::string>& arguments,
                         const std::string& dot, const std::string& name) {
  return base::run_program({.name = program,
                            .arguments = arguments,
                            .input = dot,
                            .purpose = "topology " + name,
                            .remedy = "install graphviz, or ask for the format dot"});
}

std::string to_svg(const Topology& topology) {
  return run_graphviz(is_tree(topology) ? "dot" : "neato", {"-Tsvg"}, to_dot(topology),
                      topology.name);
}

}  // namespace topologies
