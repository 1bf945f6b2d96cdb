#pragma once
// Quotes texts for Graphviz and runs its programs.

#include <string>
#include <vector>

namespace topologies {

/// Returns the output of a Graphviz program for the DOT text `dot`. `name` is the topology's name,
/// for messages. Throws std::runtime_error if Graphviz is not installed or fails.
std::string run_graphviz(const std::string& program, const std::vector<std::string>& arguments,
                         const std::string& dot, const std::string& name);

}  // namespace topologies
