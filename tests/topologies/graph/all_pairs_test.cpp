#include "topologies/graph/all_pairs.hpp"

#include <map>
#include <numeric>

#include "tests/topologies/support.hpp"
#include "topologies/graph/grid.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {
namespace {

// Computes the loads of links by following every message hop by hop. Each hop goes to the neighbour
// on the lowest port that leads nearer to the destination. Messages alternate between parallel
// links to this neighbour.
AllPairs walk_all_pairs(const Topology& t) {
  const auto around = neighbours(t);
  std::map<std::pair<int, int>, std::size_t> sent;
  AllPairs all;
  all.load.resize(t.links.size());
  for (int to = 0; to < t.processors; ++to) {
    const auto distance = plain_distances(t, to);
    for (int from = 0; from < t.processors; ++from) {
      all.distances.sum += distance[from];
      all.distances.longest = std::max(all.distances.longest, distance[from]);
      for (int at = from; at != to;) {
        const auto hop = std::ranges::find_if(
            around[at], [&](const auto& n) { return distance[n.processor] < distance[at]; });
        const int next = hop->processor;
        std::vector<int> links;
        for (const auto& n : around[at])
          if (n.processor == next) links.push_back(n.link);
        ++all.load[links[sent[{at, next}]++ % links.size()]][at > next];
        at = next;
      }
    }
  }
  return all;
}

void expect_all_pairs(const Topology& t) {
  const auto walked = walk_all_pairs(t), found = eval_all_pairs(t);
  EXPECT_EQ(found.distances.sum, walked.distances.sum);
  EXPECT_EQ(found.distances.longest, walked.distances.longest);
  EXPECT_EQ(found.load, walked.load);
  const auto [sum, longest] = eval_distances(t);
  EXPECT_EQ(sum, walked.distances.sum);
  EXPECT_EQ(longest, walked.distances.longest);
}

class TopologyAllPairs : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Of, TopologyAllPairs, testing::ValuesIn(SPECS), SpecName());

TEST_P(TopologyAllPairs, AreThoseOfEveryMessageWalked) {
  expect_all_pairs(make_topology(GetParam()));
}

TEST(TopologyAllPairsOf, SmallGridsOfAllSizes) {
  for (int rows = 1; rows <= 6; ++rows)
    for (int columns = 1; columns <= 9; ++columns)
      for (const auto& t : {make_mesh(rows, columns), make_torus(rows, columns)}) {
        SCOPED_TRACE(t.name);
        expect_all_pairs(t);
      }
}

TEST(TopologyAllPairsOf, GridsOnAnyPortsAndWithALinkLost) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    auto t = make_topology(std::vector{"mesh:4x5", "torus:4x5", "torus:3x6", "ring:9"}[seed % 4]);
    shuffle_ports(t, random);
    EXPECT_TRUE(find_grid(t));
    expect_all_pairs(t);
    t.links.erase(t.links.begin() + static_cast<int>(random() % t.links.size()));
    if (t.links.size() >= static_cast<size_t>(t.processors)) {
      EXPECT_FALSE(find_grid(t));
    }
    expect_all_pairs(t);
  }
}

TEST(TopologyAllPairsOf, RandomNetworks) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_all_pairs(random_topology(seed, 120));
  }
}

TEST(TopologyOrbits, AreFoundWhereEachProcessorLooksTheSame) {
  const auto count = [](const std::string& spec) {
    return find_orbits(make_topology(spec)).count();
  };
  EXPECT_EQ(count("ring:9"), 1);
  EXPECT_EQ(count("torus:4x7"), 1);
  EXPECT_EQ(count("torus:2x7"), 2);
  EXPECT_EQ(count("torus:7x2"), 2);
  EXPECT_EQ(count("mesh:4x7"), 28);
  EXPECT_EQ(count("amp:9"), 9);
}

// Networks with so many pairs of processors that several threads share the work. One search covers
// 64 destinations at once.
TEST(TopologyAllPairsOf, LargeNetworksAgreeWithTheirRoutes) {
  for (const unsigned seed : {1U, 2U}) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto t = random_topology(seed, 40);
    for (unsigned k = 1; t.processors < 4000; ++k) append(t, random_topology(seed + k, 40));
    ASSERT_NO_THROW(check(t));
    const auto all = eval_all_pairs(t);
    std::int64_t passed = 0;
    for (const auto& [forward, backward] : all.load) passed += forward + backward;
    EXPECT_EQ(passed, all.distances.sum);
    EXPECT_EQ(make_routes(t).mean_distance(), eval_mean_distance(t));
    EXPECT_EQ(eval_distances(t).longest, all.distances.longest);
  }
}

// Lines, rings and their Cartesian products have closed forms for the sums of distances.
TEST(TopologyAllPairsOf, TheLargestMachinesAreKnown) {
  const std::int64_t n = 65536, side = 256;
  EXPECT_EQ(eval_all_pairs(make_line(65536)).distances.sum, n * (n * n - 1) / 3);
  EXPECT_EQ(eval_all_pairs(make_ring(65536)).distances.sum, n * (n * n / 4));
  const auto mesh = eval_all_pairs(make_mesh(256, 256));
  EXPECT_EQ(mesh.distances.sum, 2 * side * side * (side * (side * side - 1) / 3));
  EXPECT_EQ(mesh.distances.longest, 510);
  const auto torus = eval_all_pairs(make_torus(256, 256));
  EXPECT_EQ(torus.distances.sum, 2 * side * side * (side * (side * side / 4)));
  EXPECT_EQ(torus.distances.longest, 256);
  std::int64_t passed = 0;
  for (const auto& [forward, backward] : mesh.load) passed += forward + backward;
  EXPECT_EQ(passed, mesh.distances.sum);
  for (const auto& way : torus.load) passed += way[0] + way[1];
  EXPECT_EQ(passed, mesh.distances.sum + torus.distances.sum);
}

}  // namespace
}  // namespace topologies
