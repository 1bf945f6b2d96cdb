#pragma once
// The Graphviz programs.

#include <string>
#include <vector>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// A drawing by Graphviz: `dot` for wirings without cycles, `neato` for others. Throws
/// std::runtime_error when Graphviz is not installed or fails.
std::string to_svg(const Topology& topology);

/// What a Graphviz program prints for the text `dot`; `name` is the topology's, for messages.
/// Throws as to_svg does.
std::string run_graphviz(const std::string& program, const std::vector<std::string>& arguments,
                         const std::string& dot, const std::string& name);

}  // namespace topologies
