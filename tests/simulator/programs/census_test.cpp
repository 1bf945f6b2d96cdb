// What each processor does for others, counted over the routes.
#include <gtest/gtest.h>

#include <algorithm>

#include "base/errors.hpp"
#include "simulator/declare/program.hpp"
#include "tests/topologies/support.hpp"

namespace programs {
namespace {

const Pattern& census() { return *std::ranges::find(all_patterns(), "census", &Pattern::name); }

Rows run_census(const topologies::Topology& topology, double pairs) {
  static const auto model = machine::load_model("t805-25");
  Setup setup{model, topology, {{"pairs", pairs}}, nullptr, &census()};
  setup.routes = topologies::make_routes(topology);
  return census().run(setup);
}

// A route of d links passes through d - 1 processors; each link has one lower end.
TEST(PatternsCensus, EveryLinkOfEveryRouteIsCounted) {
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
    for (const auto& [pairs, expected] : {std::pair(0.0, all), {1.0, of_root}}) {
      double through = 0, lower = 0, processor = 0;
      for (const auto& row : run_census(topology, pairs).rows) {
        EXPECT_EQ(row.at(0), (Row::value_type{"processor", processor++}));
        through += row.at(1).second;
        lower += row.at(2).second;
      }
      EXPECT_EQ(processor, topology.processors);
      EXPECT_EQ(through, expected);
      EXPECT_EQ(lower, static_cast<double>(topology.links.size()));
    }
  }
}

TEST(PatternsCensus, NotesSayWhoIsPassedMost) {
  const auto rows = run_census(topologies::make_topology("line:3"), 0);
  EXPECT_EQ(rows.notes, std::vector<std::string>{"p1 is on the way of most routes, 2 of 6"});
  EXPECT_TRUE(run_census(topologies::make_topology("ring:3"), 0).notes.empty());
}

TEST(PatternsChoices, AreTextsOfTheirPattern) {
  const auto model = machine::load_model("t805-25");
  programs::Setup setup{model, {}, {{"pairs", 1}, {"more", 0}}, nullptr, &census()};
  EXPECT_EQ(setup.choice("pairs"), "root");
  EXPECT_THROW(setup.choice("more"), base::InvariantBroken);
  EXPECT_THROW(setup.choice("missing"), base::InvariantBroken);
  setup.parameters["pairs"] = 2;
  EXPECT_THROW(setup.choice("pairs"), base::InvariantBroken);
  const auto method = make_choice("method", {"chalmers", "green", "classes"}, "of the routers");
  EXPECT_EQ(method.value, 0);
  EXPECT_EQ(method.low, 0);
  EXPECT_EQ(method.high, 2);
  EXPECT_TRUE(method.whole);
}

}  // namespace
}  // namespace programs
