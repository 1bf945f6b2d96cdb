#include "topologies/route/given_routes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "tests/topologies/support.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {
namespace {

using Path = std::vector<int>;

// Follows a route of the table hop by hop. Stops if the route is a loop.
Path walk(const Topology& t, const RoutingTable& routes, int from, int to) {
  const auto around = neighbours(t);
  Path path{from};
  while (path.back() != to && std::ssize(path) <= t.processors)
    path.push_back(
        std::ranges::find(around[path.back()], routes.next_port(path.back(), to), &Neighbour::port)
            ->processor);
  return path;
}

const std::string COLUMNS = "from,to,path\n";

TEST(TopologyGivenRoutes, AreForBothWaysAndForThoseOnTheWay) {
  const auto ring = make_topology("ring:6");
  const auto routes =
      read_routes(ring, "# a comment\r\n" + COLUMNS + "\n0, 2, 0-5-4-3-2\n# the end", "r.csv");
  EXPECT_EQ(walk(ring, routes, 0, 2), (Path{0, 5, 4, 3, 2}));
  EXPECT_EQ(walk(ring, routes, 2, 0), (Path{2, 3, 4, 5, 0}));
  EXPECT_EQ(routes.distance(0, 2), 4);
  EXPECT_EQ(walk(ring, routes, 5, 2), (Path{5, 4, 3, 2})) << "on the way";
  EXPECT_EQ(walk(ring, routes, 1, 2), (Path{1, 2})) << "a neighbour";
  EXPECT_EQ(walk(ring, routes, 0, 1), (Path{0, 1}));
  EXPECT_EQ(walk(ring, routes, 3, 1), walk(ring, make_routes(ring), 3, 1));
}

TEST(TopologyGivenRoutes, GoOneWayThereAndAnotherBack) {
  const auto ring = make_topology("ring:6");
  for (const auto& rows : {"0,3,0-1-2-3\n3,0,3-4-5-0\n", "3,0,3-4-5-0\n0,3,0-1-2-3\n"}) {
    const auto routes = read_routes(ring, COLUMNS + rows, "r.csv");
    EXPECT_EQ(walk(ring, routes, 0, 3), (Path{0, 1, 2, 3}));
    EXPECT_EQ(walk(ring, routes, 3, 0), (Path{3, 4, 5, 0}));
    EXPECT_EQ(walk(ring, routes, 1, 3), (Path{1, 2, 3}));
    EXPECT_EQ(walk(ring, routes, 4, 0), (Path{4, 5, 0}));
  }
}

TEST(TopologyGivenRoutes, WithoutAnyAreTheShortest) {
  const auto t = make_topology("mesh:3x4");
  const auto shortest = make_routes(t);
  for (const auto& text : {COLUMNS, "\xEF\xBB\xBF" + COLUMNS + "0,1,0-1\n"}) {
    const auto routes = read_routes(t, text, "r.csv");
    for (int from = 0; from < t.processors; ++from)
      for (int to = 0; to < t.processors; ++to) {
        EXPECT_EQ(routes.next_port(from, to), shortest.next_port(from, to));
        EXPECT_EQ(routes.distance(from, to), shortest.distance(from, to));
      }
    EXPECT_EQ(routes.mean_distance(), shortest.mean_distance());
  }
}

// Paths along one random spanning tree never disagree about the next hop to a destination.
TEST(TopologyGivenRoutes, OfRandomPathsAllArrive) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto t = random_topology(seed);
    std::mt19937 random(seed);
    auto links = t.links;
    std::ranges::shuffle(links, random);
    Topology tree{"tree", t.processors, 0, {}, {}, {}};
    for (const auto& link : links)
      if (plain_distances(tree, link.a.processor)[link.b.processor] < 0) tree.links.push_back(link);
    sort_links(tree);
    const auto along_tree = make_routes(tree);
    std::string text = COLUMNS;
    std::vector<Path> given;
    for (int from = 0; from < t.processors; ++from)
      for (int to = 0; to < t.processors; ++to)
        if (from != to && random() % 4 == 0) {
          given.push_back(walk(tree, along_tree, from, to));
          text += fmt::format("{},{},{}\n", from, to, fmt::join(given.back(), "-"));
        }
    const auto routes = read_routes(t, text, "r.csv");
    for (const auto& path : given) EXPECT_EQ(walk(t, routes, path.front(), path.back()), path);
    for (int from = 0; from < t.processors; ++from)
      for (int to = 0; to < t.processors; ++to) {
        const auto path = walk(t, routes, from, to);
        EXPECT_EQ(path.back(), to) << from;
        EXPECT_EQ(routes.distance(from, to), std::ssize(path) - 1) << from << " to " << to;
      }
  }
}

TEST(TopologyGivenRoutes, MistakesAreNamedWithTheirLine) {
  const auto ring = make_topology("ring:6");
  for (const auto& [rows, message] : std::vector<std::pair<std::string, std::string>>{
           {"0,2,0-2\n", "r.csv:2: found a step from 0 to 2, expected a link of ring:6"},
           {"0,2,0-1-2\n0,6,0-1\n", "r.csv:3: found \"6\", expected a processor from 0 to 5"},
           {"0,2,0-1\n", "r.csv:2: found the path 0-1, expected a path from 0 to 2"},
           {"0,0,0\n", "expected a path from 0 to 0"},
           {"0,1,0--1\n", "found \"\", expected a processor"},
           {"0,2,0-1-0-1-2\n", "expected each processor at most once"},
           {"0,2\n", "r.csv:2: found \"0,2\", expected from,to,path"},
           {"0,2,0-1-2\n# as long\n5,2,5-0-5-4-3-2\n", "r.csv:4: found the path"},
           {"0,3,0-1-2-3\n5,3,5-4-3\n1,3,1-0-5-4-3\n",
            "r.csv:4: found the path 1-0-5-4-3, which goes from 1 to 3 by 0, and in line 2 the "
            "path 0-1-2-3, which goes by 2; expected the same next processor"},
           {"0,3,0-1-2-3\n4,0,4-3-2-1-0\n3,0,3-4-5-0\n",
            "r.csv:4: found the path 3-4-5-0, which goes from 3 to 0 by 4"},
           {"0,3,0-1-2\n", "r.csv:2: found the path 0-1-2, expected a path from 0 to 3"}}) {
    const auto told = rejection([&, rows = rows] { read_routes(ring, COLUMNS + rows, "r.csv"); });
    EXPECT_NE(told.find(message), std::string::npos) << rows << told;
  }
  EXPECT_NE(rejection([&] { read_routes(ring, "a,b\n", "r.csv"); }).find("expected from,to,path"),
            std::string::npos);
  EXPECT_EQ(rejection([&] { read_routes(ring, "", "r.csv"); }),
            "r.csv:1: no header line, expected column names");
  EXPECT_EQ(rejection([&] { load_routes(ring, "none.csv"); }),
            "none.csv: cannot be read: No such file or directory");
}

TEST(TopologyTreeLinks, OfAnyRootJoinAll) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto t = random_topology(seed);
    auto links = make_tree_links(t);
    EXPECT_EQ(std::ssize(links), t.processors - 1);
    const auto sorted = links;
    std::ranges::reverse(links);
    for (auto& [a, b] : links) std::swap(a, b);
    EXPECT_EQ(check_tree_links(t, links), sorted);
  }
}

TEST(TopologyTreeLinks, MistakesAreNamed) {
  const auto mesh = make_topology("mesh:2x2");  // links 0-1, 0-2, 1-3, 2-3
  for (const auto& [links, message] : std::vector<std::pair<TreeLinks, std::string>>{
           {{{0, 1}, {0, 3}, {1, 2}}, "found [0, 3], which is not a link of the network"},
           {{{0, 1}, {1, 0}, {1, 3}}, "found [1, 0], twice"},
           {{{0, 1}, {0, 2}, {1, 3}, {3, 2}},
            "found [3, 2], which closes a cycle; expected the "
            "links of a spanning tree of mesh:2x2"},
           {{{0, 1}, {1, 3}}, "found no path from the root 0 to processor 2"}}) {
    const auto told = rejection([&, links = links] { check_tree_links(mesh, links); });
    EXPECT_NE(told.find(message), std::string::npos) << told;
  }
  auto line = make_topology("line:3");
  line.root = 2;
  const auto told = rejection([&] { check_tree_links(line, {{1, 2}}); });
  EXPECT_NE(told.find("found no path from the root 2 to processor 0"), std::string::npos) << told;
}

}  // namespace
}  // namespace topologies
