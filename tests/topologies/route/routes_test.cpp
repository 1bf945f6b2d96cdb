#include "topologies/route/routes.hpp"

#include "tests/topologies/support.hpp"
#include "topologies/make/generators.hpp"

namespace topologies {
namespace {

// Every route arrives, over links that exist, in as many hops as a plain search counts; each hop
// takes the lowest port that leads nearer.
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

TEST(TopologyRouteRules, MeshGoesNorthThenAlongTheRowThenSouth) {
  const auto routes = make_routes(make_topology("mesh:3x3"));
  EXPECT_EQ(routes.next_port(8, 0), 0);
  EXPECT_EQ(routes.next_port(0, 8), 2);
  EXPECT_EQ(routes.next_port(2, 6), 1);
  EXPECT_EQ(routes.next_port(0, 6), 3);
}

// The directions of links that routes hold while waiting for the next must not close a cycle.
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
