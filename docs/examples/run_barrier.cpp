// Runs the program of barrier.cpp on a topology, as `tlab run` would.
#include <fmt/format.h>

#include "simulator/programs/declare/program.hpp"
#include "topologies/make/generators.hpp"

namespace programs {
Program make_barrier();
}

int main(int argc, char** argv) {
  const std::string spec = argc > 1 ? argv[1] : "tree:13";
  const auto program = programs::make_barrier();
  const auto model = machine::load_model("t805-25");
  const programs::Setup setup{model, topologies::make_topology(spec)};
  for (const auto& row : program.run(setup, program.defaults).rows)
    fmt::print("{:9}  barrier {:8.3f} us, depth {}\n", spec, 1e6 * std::get<double>(row[0].second),
               std::get<std::int64_t>(row[1].second));
}
