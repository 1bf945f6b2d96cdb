#include "topologies/draw/graphviz.hpp"

#include "base/host_program.hpp"

namespace topologies {

std::string run_graphviz(const std::string& program, const std::vector<std::string>& arguments,
                         const std::string& dot, const std::string& name) {
  return base::run_program({.name = program,
                            .arguments = arguments,
                            .input = dot,
                            .purpose = "topology " + name,
                            .remedy = "install graphviz, or use the format dot"});
}

}  // namespace topologies
