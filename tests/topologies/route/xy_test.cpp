// Tests dimension-order routes, and the loads of links for all-to-all messages on given routes.
#include <map>
#include <numeric>

#include "tests/topologies/support.hpp"
#include "topologies/graph/all_pairs.hpp"
#include "topologies/graph/metrics.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/given_routes.hpp"
#include "topologies/route/route_load.hpp"
#include "topologies/route/up_down.hpp"

namespace topologies {
namespace {

// Calls `visit` for each route with the processors on it, from one end to the other.
template <typename Visit>
void for_each_route(const Topology& t, const RoutingTable& routes, Visit visit) {
  const auto peers = make_peers(t);
  for (int to = 0; to < t.processors; ++to)
    for (int from = 0; from < t.processors; ++from) {
      std::vector<int> path{from};
      while (path.back() != to && std::ssize(path) <= t.processors)
        path.push_back(peers[path.back()][routes.next_port(path.back(), to)]);
      visit(path);
    }
}

const std::vector<std::string> GRIDS{"mesh:1x6",  "mesh:6x1",  "mesh:4x5",  "mesh:8x8",
                                     "torus:3x3", "torus:4x4", "torus:5x6", "torus:2x5",
                                     "torus:1x1", "torus:7x8", "mesh:3x9"};

TEST(TopologyXyRoutes, GoAlongTheRowFirstAndAreShortest) {
  for (const auto& spec : GRIDS) {
    SCOPED_TRACE(spec);
    auto t = make_topology(spec);
    for (const bool shuffled : {false, true}) {
      std::mt19937 random(7);
      if (shuffled) shuffle_ports(t, random);
      const auto routes = make_xy_routes(t);
      const int columns = t.shape.columns;
      for_each_route(t, routes, [&](const std::vector<int>& path) {
        EXPECT_EQ(std::ssize(path) - 1, plain_distances(t, path.back())[path.front()]);
        EXPECT_EQ(routes.distance(path.front(), path.back()), std::ssize(path) - 1);
        for (std::size_t i = 0; i + 1 < path.size(); ++i)
          EXPECT_EQ(path[i] / columns == path[i + 1] / columns,
                    path[i] % columns != path.back() % columns)
              << path.front() << " to " << path.back() << " at " << path[i];
      });
      EXPECT_EQ(routes.mean_distance(), make_routes(t).mean_distance());
    }
  }
}

// In a hypercube, port 0 is the fourth dimension; ports 1 to 3 are the others.
TEST(TopologyXyRoutes, OfHypercubesCorrectDimensionsByAscendingPort) {
  for (int d = 0; d <= 4; ++d) {
    const auto t = make_topology("hypercube:" + std::to_string(d));
    for_each_route(t, make_xy_routes(t), [&](const std::vector<int>& path) {
      for (std::size_t i = 0; i + 1 < path.size(); ++i) {
        const auto left = static_cast<unsigned>(path[i] ^ path.back());
        EXPECT_EQ(static_cast<unsigned>(path[i] ^ path[i + 1]), left & 8 ? 8 : left & -left);
      }
    });
  }
}

TEST(TopologyXyRoutes, CloseNoCycleOnMeshesAndHypercubes) {
  const auto closes = [](const std::string& spec) {
    const auto t = make_topology(spec);
    return closes_cycle(t, make_xy_routes(t), make_tree_links(t));
  };
  for (const auto* spec : {"mesh:8x8", "mesh:3x9", "mesh:64x64", "hypercube:4"})
    EXPECT_FALSE(closes(spec)) << spec;
  for (const auto* spec : {"torus:4x4", "torus:7x8", "torus:64x64"})
    EXPECT_TRUE(closes(spec)) << spec;
}

// The middle link of a row carries all messages from its half of the row to the other half of the
// machine.
TEST(TopologyXyRoutes, LoadTheBusiestLinkOfAMeshAsItsBisectionSays) {
  for (const int side : {2, 4, 8, 16}) {
    const auto t = make_mesh(side, side);
    const auto load = eval_load(t, make_xy_routes(t));
    EXPECT_EQ(find_busiest(t, load).messages, side * side * side / 4) << side;
  }
}

TEST(TopologyXyRoutes, AreOfMeshesToriAndHypercubesOnly) {
  auto unknown = make_topology("mesh:3x3");
  unknown.shape = {};
  for (const auto& t : {make_topology("tree:7"), make_topology("ring:5"), unknown})
    EXPECT_NE(rejection([&] { find_routes(t, "xy"); }).find("expected a mesh, torus or hyper"),
              std::string::npos)
        << t.name;
}

TEST(TopologyRouteLoad, IsThatOfEveryMessageWalked) {
  const auto expect_walked = [](const Topology& t, const RoutingTable& routes) {
    // number of messages by pair of neighbours, summed over parallel links
    std::map<std::pair<int, int>, std::int64_t> sent;
    for_each_route(t, routes, [&](const std::vector<int>& path) {
      for (std::size_t i = 0; i + 1 < path.size(); ++i) ++sent[{path[i], path[i + 1]}];
    });
    std::map<std::pair<int, int>, std::vector<std::int64_t>> found;
    const auto load = eval_load(t, routes);
    for (std::size_t i = 0; i < load.size(); ++i) {
      const int a = t.links[i].a.processor, b = t.links[i].b.processor;
      found[{a, b}].push_back(load[i][0]);
      found[{b, a}].push_back(load[i][1]);
    }
    for (const auto& [way, loads] : found) {
      EXPECT_EQ(std::accumulate(loads.begin(), loads.end(), std::int64_t{}), sent[way]);
      const auto [least, most] = std::ranges::minmax(loads);
      EXPECT_LE(most - least, 1);
    }
  };
  for (const auto& spec : GRIDS)
    expect_walked(make_topology(spec), make_xy_routes(make_topology(spec)));
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto t = random_topology(seed);
    expect_walked(t, make_routes(t));
    expect_walked(t, make_up_down_routes(t));
    EXPECT_EQ(eval_load(t, make_routes(t)), eval_all_pairs(t).load);
  }
}

}  // namespace
}  // namespace topologies
