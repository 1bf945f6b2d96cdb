#include "topologies/route/up_down.hpp"

#include <map>
#include <set>

#include "tests/topologies/support.hpp"
#include "topologies/graph/grid.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {
namespace {

// The connected component of each processor, named by its lowest processor, or by the root if it
// contains the root.
std::vector<int> find_parts(const Topology& t) {
  std::vector<int> part(t.processors, -1);
  const auto fill = [&](int start) {
    const auto distance = plain_distances(t, start);
    for (int p = 0; p < t.processors; ++p)
      if (distance[p] >= 0) part[p] = start;
  };
  fill(t.root);
  for (int p = 0; p < t.processors; ++p)
    if (part[p] < 0) fill(p);
  return part;
}

// Expects a route exactly if a path exists. Each hop must use a link, and the table must state the
// correct number of hops.
void expect_routes_reach_all(const Topology& t, const RoutingTable& routes) {
  const auto around = neighbours(t);
  for (int to = 0; to < t.processors; ++to) {
    const auto distance = plain_distances(t, to);
    for (int from = 0; from < t.processors; ++from) {
      ASSERT_EQ(routes.distance(from, to) < 0, distance[from] < 0) << from << " to " << to;
      if (distance[from] < 0) {
        EXPECT_EQ(routes.next_port(from, to), -1);
        continue;
      }
      int links = 0;
      for (int at = from; at != to; ++links) {
        ASSERT_EQ(routes.distance(at, to), routes.distance(from, to) - links);
        ASSERT_LT(links, t.processors) << from << " to " << to;
        const auto hop = std::ranges::find(around[at], routes.next_port(at, to), &Neighbour::port);
        ASSERT_NE(hop, around[at].end()) << from << " to " << to;
        at = hop->processor;
      }
      ASSERT_EQ(routes.distance(from, to), links) << from << " to " << to;
      ASSERT_GE(links, distance[from]);
    }
  }
}

// Expects that no route goes up after it went down. A hop goes up if it leads nearer to the root
// or, at equal distance from the root, to a processor with a lower number.
void expect_up_then_down(const Topology& t, const RoutingTable& routes) {
  const auto around = neighbours(t);
  const auto part = find_parts(t);
  std::vector<std::pair<int, int>> height;  // heights of the processors; the root is highest
  for (int p = 0; p < t.processors; ++p) height.emplace_back(plain_distances(t, part[p])[p], p);
  for (int to = 0; to < t.processors; ++to)
    for (int from = 0; from < t.processors; ++from) {
      bool down = false;
      for (int at = from; routes.next_port(at, to) >= 0;) {
        const int port = routes.next_port(at, to);
        const int next = std::ranges::find(around[at], port, &Neighbour::port)->processor;
        ASSERT_FALSE(down && height[next] < height[at]) << from << " to " << to << " at " << at;
        down = height[at] < height[next];
        at = next;
      }
    }
}

void expect_valid_up_down(const Topology& t) {
  const auto routes = make_up_down_routes(t);
  expect_routes_reach_all(t, routes);
  expect_up_then_down(t, routes);
  EXPECT_FALSE(closes_cycle(t, routes, make_tree_links(t)));
}

// A random_topology with a random root and up to eight more processors.
Topology random_machine(unsigned seed) {
  auto t = random_topology(seed);
  std::mt19937 random(seed + 1);
  for (int more = static_cast<int>(random() % 9); more > 0; --more) {
    int at = static_cast<int>(random() % static_cast<unsigned>(t.processors));
    while (free_port(t, at) < 0) at = (at + 1) % t.processors;
    t.links.push_back({{at, free_port(t, at)}, {t.processors++, 1}});
  }
  sort_links(t);
  return t;
}

class TopologyUpDown : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Of, TopologyUpDown, testing::ValuesIn(SPECS), SpecName());

TEST_P(TopologyUpDown, ReachesAllAndClosesNoCycle) {
  expect_valid_up_down(make_topology(GetParam()));
}

TEST(TopologyRandomUpDown, ReachesAllAndClosesNoCycle) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto t = random_machine(seed);
    ASSERT_NO_THROW(check(t));
    ASSERT_LE(t.processors, 40);
    expect_valid_up_down(t);
  }
}

TEST(TopologyRandomUpDown, RoutesInPiecesEndWhereNoWayIsLeft) {
  int in_pieces = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto t = random_machine(seed);
    std::mt19937 random(seed);
    std::erase_if(t.links, [&](const Link&) { return random() % 4 == 0; });
    in_pieces += std::ranges::count(plain_distances(t, t.root), -1) > 0 ? 1 : 0;
    expect_routes_reach_all(t, make_routes(t));
    expect_valid_up_down(t);
  }
  EXPECT_GT(in_pieces, 100);
}

TEST(TopologyClosesCycle, OfShortestRoutesOnRingsAndTori) {
  const auto closes = [](const std::string& spec) {
    const auto t = make_topology(spec);
    return closes_cycle(t, make_routes(t), make_tree_links(t));
  };
  for (const auto* spec : {"ring:4", "ring:5", "ring:9", "torus:4x4"})
    EXPECT_TRUE(closes(spec)) << spec;
  for (const auto* spec :
       {"line:1", "line:9", "ring:3", "tree:20", "star:5", "mesh:4x4", "mesh:5x3", "hypercube:4"})
    EXPECT_FALSE(closes(spec)) << spec;
}

// Collects all waits of one link for another, on every route and in the tree. Then repeatedly
// removes links that wait for no link. If links remain, there is a cycle.
bool closes_cycle_plainly(const Topology& t, const RoutingTable& routes, const TreeLinks& tree) {
  const int n = t.processors;
  const auto peers = make_peers(t);
  std::map<std::pair<int, int>, std::set<std::pair<int, int>>> waits;
  for (int to = 0; to < n; ++to)
    for (int at = 0; at < n; ++at)
      if (const int port = routes.next_port(at, to); port >= 0 && peers[at][port] != to) {
        const int next = peers[at][port];
        waits[{at, next}].emplace(next, peers[next][routes.next_port(next, to)]);
      }
  TreeLinks ways = tree;
  for (const auto& [a, b] : tree) ways.emplace_back(b, a);
  for (const auto& [a, b] : ways)
    for (const auto& [c, d] : ways)
      if (b == c && d != a) waits[{a, b}].emplace(c, d);
  for (bool gone = true; gone;) {
    gone = false;
    for (auto& [way, nexts] : waits) {
      std::erase_if(nexts, [&](const auto& next) {
        const auto found = waits.find(next);
        return found == waits.end() || found->second.empty();
      });
    }
    gone = std::erase_if(waits, [](const auto& of) { return of.second.empty(); }) > 0;
  }
  return !waits.empty();
}

void expect_cycle_as_walked(const Topology& t) {
  const auto tree = make_tree_links(t);
  std::vector all{make_routes(t), make_up_down_routes(t)};
  if (t.shape.form == Shape::Form::grid && find_grid(t)) all.push_back(make_xy_routes(t));
  for (const auto& routes : all)
    EXPECT_EQ(closes_cycle(t, routes, tree), closes_cycle_plainly(t, routes, tree)) << t.name;
}

TEST(TopologyClosesCycle, AsAllRoutesWalkedTell) {
  for (int rows = 1; rows <= 9; ++rows)
    for (int columns = rows; columns <= 9; columns += 2)
      for (auto t : {make_mesh(rows, columns), make_torus(rows, columns)}) {
        std::mt19937 random(static_cast<unsigned>(10 * rows + columns));
        expect_cycle_as_walked(t);
        shuffle_ports(t, random);
        expect_cycle_as_walked(t);
      }
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto t = random_topology(seed, 90);
    expect_cycle_as_walked(t);
    std::mt19937 random(seed);
    std::erase_if(t.links, [&](const Link&) { return random() % 6 == 0; });
    expect_cycle_as_walked(t);
  }
}

TEST(TopologyClosesCycle, OfTheLargest) {
  for (const auto* spec : {"torus:256x256", "ring:65536", "amp:65536"}) {
    const auto t = make_topology(spec);
    EXPECT_TRUE(closes_cycle(t, make_routes(t), make_tree_links(t))) << spec;
  }
  for (const auto* spec : {"mesh:256x256", "tree:65536", "line:65536"}) {
    const auto t = make_topology(spec);
    EXPECT_FALSE(closes_cycle(t, make_routes(t), make_tree_links(t))) << spec;
  }
}

// Broadcasts can close a cycle even if the routes alone have none. The tree's path 0, 2, 3, 1 turns
// from a column into a row, which no route does.
TEST(TopologyClosesCycle, OfTheTreesLinksToo) {
  const auto t = make_topology("mesh:2x2");
  const auto routes = make_routes(t);
  EXPECT_FALSE(closes_cycle(t, routes, {{0, 1}, {0, 2}, {1, 3}}));
  EXPECT_TRUE(closes_cycle(t, routes, {{0, 2}, {1, 3}, {2, 3}}));
}

// In a ring of four, routes between 1 and 3 pass the root, not processor 2, which is below both.
// (promela/network.pml verifies the same ring.)
TEST(TopologyUpDownRules, RingOfFourTurnsOneRoute) {
  const auto routes = make_up_down_routes(make_topology("ring:4"));
  const std::vector<int> ports_to_3{1, 1, 2, -1};
  for (int p = 0; p < 4; ++p) EXPECT_EQ(routes.next_port(p, 3), ports_to_3[p]) << p;
  const std::vector<int> ports_to_1{2, -1, 1, 2};
  for (int p = 0; p < 4; ++p) EXPECT_EQ(routes.next_port(p, 1), ports_to_1[p]) << p;
}

}  // namespace
}  // namespace topologies
