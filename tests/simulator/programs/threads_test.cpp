// Programs must give the same rows on several threads as on one.
#include <gtest/gtest.h>

#include "tests/simulator/programs/run_program.hpp"
#include "topologies/graph/partition.hpp"

namespace programs {
namespace {

// Returns the rows and the number of events of a small run.
std::pair<std::vector<Row>, std::uint64_t> run_in_parts(const Program& program,
                                                        const std::string& topology, int threads) {
  static const auto model = machine::load_model("t805-25");
  Setup setup{model, topologies::make_topology(topology)};
  if (program.uses.routes) setup.routes = topologies::make_routes(setup.topology);
  setup.engine.links = machine::Links::direct;
  if (threads > 1) setup.engine.parts = topologies::make_partition(setup.topology, threads);
  Settings settings;
  if (program.find("window_s")) settings["window_s"] = 0.02;
  if (program.name == "global")
    settings = {{"messages", std::int64_t{50}}, {"window", std::int64_t{2}}};
  const auto outcome = run_program(program, setup, settings);
  return {outcome.rows, outcome.events};
}

TEST(Threads, GiveTheRowsOfOne) {
  int programs_tried = 0;
  for (const Program& program : all_programs()) {
    if (!program.uses.threads) continue;
    ++programs_tried;
    for (const char* topology : {"mesh:4x5", "torus:4x4", "hypercube:4", "tree:13", "ring:16"}) {
      const auto on_one = run_in_parts(program, topology, 1);
      for (const int threads : {2, 4, 16})
        EXPECT_TRUE(on_one == run_in_parts(program, topology, threads))
            << program.name << " on " << topology << ", " << threads << " threads";
    }
  }
  EXPECT_GE(programs_tried, 7);
}

}  // namespace
}  // namespace programs
