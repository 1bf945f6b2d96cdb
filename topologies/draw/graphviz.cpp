#include "topologies/draw/graphviz.hpp"

#include "base/host_program.hpp"
#include "base/text.hpp"

namespace topologies {

std::string quote_dot(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : base::blank_controls(text)) {
    if (c == '"' || c == '\\') quoted += '\\';
    quoted += c == '&' ? "&amp;" : std::string(1, c);
  }
  return quoted + '"';
}

std::string run_graphviz(const std::string& program, const std::vector<std::string>& arguments,
                         const std::string& dot, const std::string& name) {
  return base::run_program({.name = program,
                            .arguments = arguments,
                            .input = dot,
                            .purpose = "topology " + name,
                            .remedy = "install graphviz, or use the format dot"});
}

}  // namespace topologies
