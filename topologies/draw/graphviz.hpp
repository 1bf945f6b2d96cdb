#pragma once
// Quotes texts for Graphviz and runs its programs.

#include <string>
#include <vector>

namespace topologies {

/// Puts a text in quotes, as a DOT string in one line. Escapes backslashes, quotes and &.
std::string quote_dot(const std::string& text);

/// Runs a Graphviz program on the DOT text `dot` and returns its output. `name` is the topology's
/// name, for error messages. Throws std::runtime_error if Graphviz is not installed or fails.
std::string run_graphviz(const std::string& program, const std::vector<std::string>& arguments,
                         const std::string& dot, const std::string& name);

}  // namespace topologies
