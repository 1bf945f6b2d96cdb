// The Graphviz programs, run on a text. For this room only.
#pragma once

#include <string>

namespace topologies {

// What `command` ("neato -n2 -Tsvg") prints for `dot`. `name` is the topology's, for messages.
// Throws std::runtime_error when the program is not installed or fails.
std::string run_graphviz(const std::string& command, const std::string& dot,
                         const std::string& name);

}  // namespace topologies
