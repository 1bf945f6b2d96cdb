#pragma once
// The Graphviz programs.

#include <string>
#include <vector>

namespace topologies {

/// A text as a string of DOT, where a backslash starts an escape and & an entity; on one line.
std::string quote_dot(const std::string& text);

/// What a Graphviz program prints for the text `dot`; `name` is the topology's, for messages.
/// Throws std::runtime_error when Graphviz is not installed or fails.
std::string run_graphviz(const std::string& program, const std::vector<std::string>& arguments,
                         const std::string& dot, const std::string& name);

}  // namespace topologies
