// The program census: the number of routes through each processor, and the number of the
// processor's lower neighbours.
#include <gtest/gtest.h>

#include "tests/simulator/programs/run_program.hpp"
#include "tests/topologies/support.hpp"
#include "topologies/make/generators.hpp"

namespace programs {
namespace {

Outcome<Row> run_census(const topologies::Topology& topology, const std::string& pairs) {
  static const auto model = machine::load_model("t805-25");
  Setup setup{model, topology};
  setup.routes = topologies::make_routes(topology);
  return run_program("census", setup, {{"pairs", pairs}});
}

// A route of d links passes through d - 1 processors. Each link makes the processor at one of its
// ends a lower neighbour of the other.
TEST(ProgramsCensus, EveryLinkOfEveryRouteIsCounted) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto topology = topologies::random_topology(seed);
    double all = 0, of_root = 0;
    for (int from = 0; from < topology.processors; ++from) {
      const auto distances = topologies::plain_distances(topology, from);
      for (int to = 0; to < topology.processors; ++to) {
        if (from == to) continue;
        all += distances[to] - 1;
        if (from == topology.root || to == topology.root) of_root += distances[to] - 1;
      }
    }
    for (const auto& [pairs, expected] : {std::pair("all", all), {"root", of_root}}) {
      double through = 0, lower = 0;
      int processor = 0;
      for (const auto& row : run_census(topology, pairs).rows) {
        EXPECT_EQ(get_number(row, "processor"), processor++);
        through += get_number(row, "routes_through");
        lower += get_number(row, "lower_neighbours");
      }
      EXPECT_EQ(processor, topology.processors);
      EXPECT_EQ(through, expected);
      EXPECT_EQ(lower, static_cast<double>(topology.links.size()));
    }
  }
}

TEST(ProgramsCensus, NotesSayWhoIsPassedMost) {
  const auto rows = run_census(topologies::make_topology("line:3"), "all");
  EXPECT_EQ(rows.notes, std::vector<std::string>{"most routes pass through p1: 2 of 6"});
  EXPECT_TRUE(run_census(topologies::make_topology("ring:3"), "all").notes.empty());
}

TEST(ProgramsCensus, CallsProcessorsByTheirLabels) {
  auto line = topologies::make_topology("line:2");
  line.labels = {"A", "B"};
  EXPECT_EQ(get_cell(run_census(line, "all").rows.at(1), "processor"), base::Cell("B"));
}

}  // namespace
}  // namespace programs
