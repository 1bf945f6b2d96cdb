#include "topologies/route/routes.hpp"

#include "tests/topologies/support.hpp"
#include "topologies/graph/search.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/up_down.hpp"

namespace topologies {
namespace {

// Expects every route to reach its destination over existing links, in as many hops as a
// breadth-first search counts. Each hop must take the lowest port that leads nearer to the
// destination.
void expect_valid_routes(const Topology& t) {
  const auto routes = make_routes(t);
  const auto around = neighbours(t);
  for (int to = 0; to < t.processors; ++to) {
    const auto distance = plain_distances(t, to);
    for (int from = 0; from < t.processors; ++from) {
      ASSERT_EQ(routes.distance(from, to), distance[from]) << from << " to " << to;
      if (from == to) {
        EXPECT_EQ(routes.next_port(from, to), -1);
        continue;
      }
      const auto hop =
          std::ranges::find(around[from], routes.next_port(from, to), &Neighbour::port);
      ASSERT_NE(hop, around[from].end()) << from << " to " << to;
      ASSERT_EQ(distance[hop->processor], distance[from] - 1) << from << " to " << to;
      for (auto lower = around[from].begin(); lower != hop; ++lower)
        ASSERT_GE(distance[lower->processor], distance[from]) << "a lower port leads nearer";
    }
  }
}

// Expects the same as expect_valid_routes, but only of routes to the processors in `ends`.
void expect_valid_routes_to(const Topology& t, const std::vector<int>& ends) {
  const auto routes = make_routes(t);
  const auto peers = make_peers(t);
  for (const int to : ends) {
    const auto distance = make_search(t, to).distance;
    int mistakes = 0;
    for (int from = 0; from < t.processors; ++from) {
      if (from == to) continue;
      const auto nearer = [&](int peer) { return distance[peer] == distance[from] - 1; };
      const auto lowest = std::ranges::find_if(peers[from], nearer) - peers[from].begin();
      if (routes.next_port(from, to) != lowest) ++mistakes;
      if (from % 997 == 0 && routes.distance(from, to) != distance[from]) ++mistakes;
    }
    EXPECT_EQ(mistakes, 0) << t.name << " to " << to;
  }
}

void expect_valid_tree(const Topology& t, int root) {
  const auto tree = make_spanning_tree(t, root);
  const auto around = neighbours(t);
  EXPECT_EQ(tree.root, root);
  EXPECT_EQ(tree.parent[root], -1);
  EXPECT_EQ(tree.depth, plain_distances(t, root));
  int listed = 0;
  for (int p = 0; p < t.processors; ++p) {
    int last_port = -1;
    for (const int child : tree.children[p]) {
      EXPECT_EQ(tree.parent[child], p);
      EXPECT_EQ(tree.depth[child], tree.depth[p] + 1);
      const auto link = std::ranges::find(around[p], child, &Neighbour::processor);
      ASSERT_NE(link, around[p].end());
      EXPECT_GT(link->port, last_port);
      last_port = link->port;
      ++listed;
    }
  }
  EXPECT_EQ(listed, t.processors - 1);
}

class TopologyRoutes : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Of, TopologyRoutes, testing::ValuesIn(SPECS), SpecName());

TEST_P(TopologyRoutes, AreShortestHopByHop) { expect_valid_routes(make_topology(GetParam())); }

TEST_P(TopologyRoutes, SpanningTreeIsBreadthFirstFromAnyRoot) {
  const auto t = make_topology(GetParam());
  for (int root = 0; root < t.processors; ++root) expect_valid_tree(t, root);
}

TEST(TopologyRandomRoutes, AreShortestHopByHop) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto t = random_topology(seed);
    ASSERT_NO_THROW(check(t));
    expect_valid_routes(t);
    expect_valid_tree(t, t.root);
  }
}

TEST(TopologyRandomRoutes, OfGridsOnAnyPortsAndWithALinkLost) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    std::mt19937 random(seed);
    auto t = make_topology(
        std::vector{"mesh:4x5", "torus:4x5", "torus:3x6", "torus:2x6", "ring:9"}[seed % 5]);
    shuffle_ports(t, random);
    expect_valid_routes(t);
    t.links.erase(t.links.begin() + static_cast<int>(random() % t.links.size()));
    expect_valid_routes(t);
  }
}

// More destinations than a word has bits, so that the search runs in several groups.
TEST(TopologyRandomRoutes, OfSomeHundredProcessors) {
  for (unsigned seed = 0; seed < 5; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    expect_valid_routes(random_topology(seed, 300));
  }
}

TEST(TopologyRandomRoutes, MeanDistanceIsThatOfAllThatHaveAWay) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto t = random_topology(seed, 90);
    std::mt19937 random(seed);
    std::erase_if(t.links, [&](const Link&) { return random() % 6 == 0; });
    std::int64_t links = 0, pairs = 0, up_down = 0;
    const auto routes = make_routes(t), upwards = make_up_down_routes(t);
    for (int from = 0; from < t.processors; ++from)
      for (const int distance : plain_distances(t, from))
        if (distance > 0) links += distance, ++pairs;
    for (int from = 0; from < t.processors; ++from)
      for (int to = 0; to < t.processors; ++to) up_down += std::max(0, upwards.distance(from, to));
    const auto count = static_cast<double>(pairs);
    EXPECT_EQ(routes.mean_distance(), pairs ? static_cast<double>(links) / count : 0);
    EXPECT_EQ(upwards.mean_distance(), pairs ? static_cast<double>(up_down) / count : 0);
  }
}

TEST(TopologyLargeRoutes, TakeTheLowestPortThatLeadsNearer) {
  std::mt19937 random(1);
  for (const auto* spec :
       {"line:65536", "ring:65535", "tree:65536", "binary:65536", "mesh:256x256", "mesh:1024x64",
        "torus:256x256", "torus:257x255", "torus:2x32768", "amp:65536"}) {
    const auto t = make_topology(spec);
    const auto any = static_cast<int>(random() % static_cast<unsigned>(t.processors));
    expect_valid_routes_to(t, {0, any, t.processors - 1});
  }
}

TEST(TopologyRouteRules, MeshGoesNorthThenAlongTheRowThenSouth) {
  const auto routes = make_routes(make_topology("mesh:3x3"));
  EXPECT_EQ(routes.next_port(8, 0), 0);
  EXPECT_EQ(routes.next_port(0, 8), 2);
  EXPECT_EQ(routes.next_port(2, 6), 1);
  EXPECT_EQ(routes.next_port(0, 6), 3);
}

// A message holds one direction of a link while it waits for the next. These waits must not form a
// cycle.
TEST(TopologyRouteRules, MeshAndHypercubeHaveNoCycleOfWaitingLinks) {
  for (const auto* spec : {"mesh:4x5", "mesh:5x3", "hypercube:3", "hypercube:4", "tree:20"}) {
    const auto t = make_topology(spec);
    const auto routes = make_routes(t);
    const auto around = neighbours(t);
    const auto next = [&](int p, int to) {
      return std::ranges::find(around[p], routes.next_port(p, to), &Neighbour::port)->processor;
    };
    const int n = t.processors;
    std::vector<std::vector<int>> waits(n * n);
    std::vector<int> blockers(n * n, 0);
    for (int from = 0; from < n; ++from)
      for (int to = 0; to < n; ++to)
        if (from != to && next(from, to) != to) {
          const int via = next(from, to), held = from * n + via, wanted = via * n + next(via, to);
          waits[held].push_back(wanted), ++blockers[wanted];
        }
    std::vector<int> ready;
    for (int d = 0; d < n * n; ++d)
      if (!blockers[d]) ready.push_back(d);
    for (size_t i = 0; i < ready.size(); ++i)
      for (const int d : waits[ready[i]])
        if (!--blockers[d]) ready.push_back(d);
    EXPECT_EQ(ready.size(), static_cast<size_t>(n * n)) << spec;
  }
}

TEST(TopologyRouteRules, LongestLineFitsItsTable) {
  const auto routes = make_routes(make_topology("line:2000"));
  EXPECT_EQ(routes.distance(0, 1999), 1999);
  EXPECT_EQ(routes.next_port(0, 1999), 2);
  EXPECT_EQ(routes.next_port(1999, 0), 1);
}

}  // namespace
}  // namespace topologies
