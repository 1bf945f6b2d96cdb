#pragma once
// Calls of the Graphviz programs.

#include <string>
#include <vector>

namespace topologies {

/// Quotes a text as a DOT string on one line; escapes backslashes, quotes and &.
std::string quote_dot(const std::string& text);

/// The output of a Graphviz program for the text `dot`; `name` is the topology's, for messages.
/// Throws std::runtime_error if Graphviz is not installed or fails.
std::string run_graphviz(const std::string& program, const std::vector<std::string>& arguments,
                         const std::string& dot, const std::string& name);

}  // namespace topologies
