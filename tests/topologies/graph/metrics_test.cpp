#include "topologies/graph/metrics.hpp"

#include <bit>
#include <cmath>
#include <random>

#include "base/errors.hpp"
#include "tests/topologies/support.hpp"
#include "topologies/graph/all_pairs.hpp"
#include "topologies/graph/bisection.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/routes.hpp"

namespace topologies {
namespace {

struct Expected {
  int links, diameter;
  double mean;
  int bisection;
};

void expect_metrics(const Topology& t, const Expected& expected) {
  SCOPED_TRACE(t.name);
  const auto m = eval_metrics(t);
  EXPECT_EQ(m.processors, t.processors);
  EXPECT_EQ(m.links, expected.links);
  EXPECT_EQ(m.diameter, expected.diameter);
  EXPECT_NEAR(m.mean_distance, expected.mean, 1e-12);
  EXPECT_EQ(m.bisection_width, expected.bisection);
}

// Sums of distances over ordered pairs: n * floor(n^2 / 4) for a ring, n (n^2 - 1) / 3 for a line.
// In a Cartesian product of two graphs, the distances of one factor count once for each ordered
// pair of vertices of the other factor.
double ring_sum(double n) { return n * std::floor(n * n / 4); }
double line_sum(double n) { return n * (n * n - 1) / 3; }
double product_mean(double sum_r, double r, double sum_c, double c) {
  const double n = r * c;
  return n == 1 ? 0 : (sum_r * c * c + sum_c * r * r) / (n * (n - 1));
}

TEST(TopologyClosedForms, Line) {
  expect_metrics(make_line(1), {0, 0, 0, 0});
  for (int n = 2; n <= 33; ++n) expect_metrics(make_line(n), {n - 1, n - 1, (n + 1) / 3.0, 1});
}

TEST(TopologyClosedForms, Ring) {
  for (int n = 3; n <= 33; ++n)
    expect_metrics(make_ring(n), {n, n / 2, ring_sum(n) / (n * (n - 1.0)), 2});
}

TEST(TopologyClosedForms, Mesh) {
  for (int r = 1; r <= 7; ++r)
    for (int c = 1; c <= 7; ++c) {
      const auto [narrow, wide] = std::minmax(r, c);
      const int bisection = wide == 1 ? 0 : narrow == 1 ? 1 : narrow + wide % 2;
      expect_metrics(make_mesh(r, c), {r * (c - 1) + c * (r - 1), r + c - 2,
                                       product_mean(line_sum(r), r, line_sum(c), c), bisection});
    }
}

TEST(TopologyClosedForms, Torus) {
  for (int r = 3; r <= 8; ++r)
    for (int c = 3; c <= 8; ++c) {
      const int bisection = 2 * (std::min(r, c) + std::max(r, c) % 2);
      expect_metrics(make_torus(r, c), {2 * r * c, r / 2 + c / 2,
                                        product_mean(ring_sum(r), r, ring_sum(c), c), bisection});
    }
}

TEST(TopologyClosedForms, Hypercube) {
  expect_metrics(make_hypercube(0), {0, 0, 0, 0});
  for (int d = 1; d <= 4; ++d) {
    const int n = 1 << d;
    expect_metrics(make_hypercube(d), {d * n / 2, d, d * (n / 2) / (n - 1.0), n / 2});
  }
}

// The distances in a tree are a sum over its links: a link with s processors below it lies on 2 s
// (n - s) routes. The children of the last level are dealt out to subtrees in turn, so that two
// processors of the deepest level are always far apart.
TEST(TopologyClosedForms, Tree) {
  for (int n = 2; n <= 60; ++n) {
    const auto t = make_tree(n);
    const auto tree = make_spanning_tree(t, 0);
    const int height = std::ranges::max(tree.depth);
    const auto deepest = std::ranges::count(tree.depth, height);
    std::vector<int> below(n, 1);
    double sum = 0;
    for (int p = n - 1; p > 0; --p) {
      below[tree.parent[p]] += below[p];
      sum += 2.0 * below[p] * (n - below[p]);
    }
    const auto m = eval_metrics(t);
    EXPECT_EQ(m.links, n - 1);
    EXPECT_EQ(m.diameter, 2 * height - (deepest == 1)) << n;
    EXPECT_NEAR(m.mean_distance, sum / (n * (n - 1.0)), 1e-12) << n;
    EXPECT_EQ(m.farm.messages, *std::max_element(below.begin() + 1, below.end())) << n;
  }
}

// Tries every division of the machine into two halves.
int brute_bisection(const Topology& t) {
  int best = static_cast<int>(t.links.size());
  for (unsigned half = 0; half < 1u << (t.processors - 1); ++half) {
    const int count = std::popcount(half);
    if (count != t.processors / 2 && count != (t.processors + 1) / 2) continue;
    const auto side = [&](int p) { return half >> p & 1; };
    best = std::min<int>(best, std::ranges::count_if(t.links, [&](const Link& l) {
                           return side(l.a.processor) != side(l.b.processor);
                         }));
  }
  return best;
}

TEST(TopologyBisection, IsTheLeastOfAllHalvings) {
  for (const auto* spec :
       {"line:9",   "ring:3",   "ring:8",    "mesh:2x3",  "mesh:3x3",  "mesh:3x5",  "mesh:4x3",
        "mesh:4x4", "mesh:2x7", "torus:3x3", "torus:3x4", "torus:3x5", "torus:4x4", "hypercube:4",
        "star:5",   "tree:7",   "tree:13",   "tree:16",   "tree:15:2", "tree:14:2"}) {
    const auto t = make_topology(spec);
    EXPECT_EQ(eval_metrics(t).bisection_width, brute_bisection(t)) << spec;
  }
}

// For random networks of up to 16 processors, the result must be that of a search of all divisions
// into halves. For grids, rings and trees of up to 32 processors, it must be the known result.
TEST(TopologyBisection, BranchAndBoundFindsTheLeast) {
  const std::uint64_t seed = 20261125;
  std::mt19937_64 random(seed);
  for (int trial = 0; trial < 60; ++trial) {
    const int n = 2 + static_cast<int>(random() % 15);
    Topology t{"random", n, 0, {}, {}, {}};
    for (int p = 1; p < n; ++p) {
      const int links = 1 + static_cast<int>(random() % 3);
      for (int i = 0; i < links; ++i)  // links may repeat, so parallel links occur
        t.links.push_back({{static_cast<int>(random() % static_cast<unsigned>(p)), 0}, {p, 0}});
    }
    EXPECT_EQ(eval_bisection(t), brute_bisection(t)) << "seed " << seed << ", trial " << trial;
  }
  for (const auto* spec :
       {"mesh:4x8", "mesh:5x6", "torus:4x8", "torus:5x5", "ring:32", "tree:31"}) {
    const auto t = make_topology(spec);
    EXPECT_EQ(eval_bisection(t), eval_metrics(t).bisection_width) << spec;
  }
}

TEST(TopologyBisection, IsUnknownOfManyWhereTheGeneratorDoesNotTellAndThereAreCycles) {
  auto t = make_ring(MOST_BISECTED + 1);
  t.bisection_width.reset();
  EXPECT_FALSE(eval_metrics(t).bisection_width);
  EXPECT_THROW(eval_bisection(t), base::BadInput);
}

// Compares the all-to-all load with counts along every route.
TEST(TopologyTraffic, AllToAllIsTheBusiestDirectionOfEveryRouteWalked) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const auto t = random_topology(seed);
    const auto routes = make_routes(t);
    const auto around = neighbours(t);
    std::vector<std::vector<int>> load(t.processors, std::vector<int>(t.processors, 0));
    for (int from = 0; from < t.processors; ++from)
      for (int to = 0; to < t.processors; ++to)
        for (int p = from; p != to;) {
          const auto hop = std::ranges::find(around[p], routes.next_port(p, to), &Neighbour::port);
          ++load[p][hop->processor];
          p = hop->processor;
        }
    int most = 0;
    for (const auto& row : load) most = std::max(most, std::ranges::max(row));
    const auto busiest = eval_metrics(t).all_to_all;
    EXPECT_EQ(busiest.messages, most);
    EXPECT_EQ(load[busiest.from][busiest.to], most);
  }
}

// The topology has two parallel links between 0 and 1, and one link between 1 and 2.
TEST(TopologyTraffic, ParallelLinksShareAllToAllAndTreesTakeOne) {
  Topology t{"parallel", 3, 0, {}, {}, {}};
  t.links = {{{0, 0}, {1, 0}}, {{1, 1}, {2, 0}}, {{0, 1}, {1, 2}}};
  const auto load = eval_all_pairs(t).load;
  // each of the two parallel links carries one of two messages each way
  EXPECT_EQ(load[0], (std::array<std::int64_t, 2>{1, 1}));
  EXPECT_EQ(load[1], (std::array<std::int64_t, 2>{2, 2}));
  EXPECT_EQ(load[2], (std::array<std::int64_t, 2>{1, 1}));
  EXPECT_EQ(eval_metrics(t).farm.messages, 2);
  t.links.push_back({{0, 2}, {1, 3}});
  const auto thirds = eval_all_pairs(t).load;
  EXPECT_EQ(thirds[0][0] + thirds[2][0] + thirds[3][0], 2);
  EXPECT_EQ(thirds[0][0], 1);  // the lowest port takes the remainder
  EXPECT_EQ(thirds[3][0], 0);
}

TEST(TopologyTraffic, KnownLoads) {
  const auto line = eval_metrics(make_line(8));
  // The replies to all seven other processors use the root's link.
  EXPECT_EQ(line.farm.messages, 7);
  EXPECT_EQ(line.all_to_all.messages, 16);  // 4 x 4 pairs cross the middle in each direction
  EXPECT_EQ(eval_metrics(make_tree(7)).farm.messages, 2);
  EXPECT_EQ(eval_metrics(make_hypercube(4)).all_to_all.messages, 8);
  const auto alone = eval_metrics(make_line(1));
  EXPECT_EQ(alone.farm.messages, 0);
  EXPECT_EQ(alone.farm.from, -1);
}

}  // namespace
}  // namespace topologies
