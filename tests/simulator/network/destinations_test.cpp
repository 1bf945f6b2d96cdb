// Traffic patterns: destinations, link loads computed from routes, and files of weights.
#include "simulator/network/destinations.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <numeric>
#include <set>

#include "simulator/observe/latencies.hpp"
#include "simulator/programs/network/traffic.hpp"
#include "tests/support/files.hpp"
#include "topologies/make/generators.hpp"
#include "topologies/route/given_routes.hpp"

namespace network {
namespace {

using topologies::make_topology;

Destinations make(Pattern pattern, const topologies::Topology& topology) {
  PatternParams params;
  params.pattern = pattern;
  return {params, topology};
}

// The only destination of a processor; -1 if it has none.
int destination(const Destinations& destinations, int from) {
  base::Random random(1);
  return destinations.draw(from, random).value_or(-1);
}

// In each permutation, all destinations must differ, and the definition must hold for every bit.
TEST(Destinations, PermutationsFollowTheirDefinitions) {
  for (const char* name : {"hypercube:2", "hypercube:4", "mesh:8x8", "line:2"}) {
    const auto topology = make_topology(name);
    const int n = topology.processors, bits = std::countr_zero(static_cast<unsigned>(n));
    for (const auto pattern : {Pattern::bit_complement, Pattern::bit_reversal, Pattern::shuffle}) {
      const auto destinations = make(pattern, topology);
      std::set<int> seen;
      for (int from = 0; from < n; ++from) {
        int to = destination(destinations, from);
        if (to < 0) to = from;
        seen.insert(to);
        for (int bit = 0; bit < bits; ++bit) {
          const bool is_set = from >> bit & 1;
          if (pattern == Pattern::bit_complement)
            EXPECT_NE(to >> bit & 1, is_set);
          else if (pattern == Pattern::bit_reversal)
            EXPECT_EQ(to >> (bits - 1 - bit) & 1, is_set);
          else
            EXPECT_EQ(to >> ((bit + 1) % bits) & 1, is_set);
        }
      }
      EXPECT_EQ(static_cast<int>(seen.size()), n);
    }
  }
  const auto transpose = make(Pattern::transpose, make_topology("mesh:5x5"));
  for (int row = 0; row < 5; ++row)
    for (int column = 0; column < 5; ++column)
      EXPECT_EQ(destination(transpose, 5 * row + column), row == column ? -1 : 5 * column + row);
}

// The largest number of messages on a direction of a link, divided by the number of messages per
// sender. Counts along the routes of many drawn messages. Parallel links share their messages.
double count_busiest(const Destinations& destinations, const topologies::Topology& topology,
                     const topologies::RoutingTable& routes, int draws, std::uint64_t seed) {
  std::map<std::pair<int, int>, double> counts, links;
  for (const auto& [a, b] : topology.links) {
    ++links[{a.processor, b.processor}];
    ++links[{b.processor, a.processor}];
  }
  for (int from = 0; from < topology.processors; ++from) {
    base::Random random(seed, from);
    for (int i = 0; i < draws; ++i) {
      const auto to = destinations.draw(from, random);
      if (!to) break;
      EXPECT_NE(*to, from);
      for (int at = from; at != *to;) {
        const int next = routes.rule->peers()[at][routes.next_port(at, *to)];
        ++counts[{at, next}];
        at = next;
      }
    }
  }
  double busiest = 0;
  for (const auto& [ends, count] : counts) busiest = std::max(busiest, count / links[ends]);
  return busiest / draws;
}

// The load computed from probabilities must agree with counted messages. The busiest of several
// equally loaded links has a count above its mean, by up to 4.5 standard deviations of a count.
TEST(Destinations, TheBusiestLinkAgreesWithCountedMessages) {
  constexpr int DRAWS = 4000;
  std::uint64_t seed = 1;
  for (const char* name : {"hypercube:4", "mesh:4x4", "torus:4x4", "ring:4", "line:16", "amp:16"})
    for (const auto pattern :
         {Pattern::uniform, Pattern::transpose, Pattern::bit_complement, Pattern::bit_reversal,
          Pattern::shuffle, Pattern::hot_spot, Pattern::neighbour}) {
      const auto topology = make_topology(name);
      const auto routes = make_routes(topology);
      const auto destinations = make(pattern, topology);
      const double exact = destinations.eval_busiest_link(topology, routes);
      const double counted = count_busiest(destinations, topology, routes, DRAWS, ++seed);
      const double deviation = std::sqrt(exact / DRAWS);
      EXPECT_NEAR(counted, exact, 4.5 * deviation)
          << name << ", pattern " << static_cast<int>(pattern) << ", seed " << seed;
    }
}

// Formulas for a mesh of k x k with dimension-order routes (Dally and Towles, sections 3.3 and 9).
TEST(Destinations, TheBusiestLinkOfAMeshFollowsTheFormulas) {
  for (const int k : {2, 4, 6, 8}) {
    const auto topology = make_topology(fmt::format("mesh:{0}x{0}", k));
    const auto routes = topologies::make_xy_routes(topology);
    const auto busiest = [&](Pattern pattern) {
      return make(pattern, topology).eval_busiest_link(topology, routes);
    };
    const double n = k * k;
    EXPECT_NEAR(busiest(Pattern::uniform), k / 4.0 * n / (n - 1), 1e-12) << k;
    EXPECT_NEAR(busiest(Pattern::transpose), k - 1, 1e-12) << k;
    if (k != 6) {  // a power of two
      EXPECT_NEAR(busiest(Pattern::bit_complement), k / 2.0, 1e-12) << k;
    }
  }
}

TEST(Destinations, MeanDistancesAgreeWithDrawnMessages) {
  const auto topology = make_topology("mesh:4x4");
  const auto routes = make_routes(topology);
  for (const auto pattern : {Pattern::uniform, Pattern::transpose, Pattern::hot_spot,
                             Pattern::neighbour, Pattern::shuffle}) {
    const auto destinations = make(pattern, topology);
    double sum = 0, count = 0;
    for (int from = 0; from < topology.processors; ++from) {
      base::Random random(7, from);
      for (int i = 0; i < 4000; ++i)
        if (const auto to = destinations.draw(from, random))
          sum += routes.distance(from, *to), ++count;
    }
    EXPECT_NEAR(sum / count, destinations.eval_mean_distance(routes), 0.02) << int(pattern);
  }
}

class WeightsFile : public testing::Test {
 protected:
  Destinations read(const std::string& text) {
    std::ofstream(folder.path / "w.csv") << text;
    PatternParams params;
    params.pattern = Pattern::file;
    params.file = {"w.csv", (folder.path / "w.csv").string()};
    return {params, make_topology("ring:4")};
  }
  test::TemporaryFolder folder;
};

TEST_F(WeightsFile, GivesTheProbabilities) {
  const auto destinations = read("from,to,weight\n0,1,3\n0,2,1\n\n3,0,1e-9\n");
  const auto arrivals = programs::make_random_traffic(4, destinations, 1e5, 1e6, 3);
  std::map<std::pair<int, int>, double> counts;
  for (const auto& arrival : arrivals) ++counts[{arrival.from, arrival.to}];
  ASSERT_EQ(counts.size(), 3U);
  EXPECT_NEAR((counts[{0, 1}] / counts[{0, 2}]), 3, 0.1);
  EXPECT_NEAR((counts[{3, 0}]), 1e5, 2e3);
}

TEST_F(WeightsFile, IsRefusedWithItsLine) {
  const std::pair<const char*, const char*> wrong[] = {
      {"", "w.csv"},
      {"a,b\n", "w.csv:1: found the columns a,b, expected from,to,weight"},
      {"from,to,weight\n", "found no row"},
      {"from,to,weight\n0,1\n", "w.csv:2: found 2 cells, expected 3"},
      {"from,to,weight\n0,4,1\n", "w.csv:2: found '4', expected the number of a processor, 0 to 3"},
      {"from,to,weight\n-1,0,1\n", "w.csv:2: found '-1'"},
      {"from,to,weight\n0,0,1\n", "w.csv:2: found 0 to 0"},
      {"from,to,weight\n0,1,0\n", "w.csv:2: weight: found '0'"},
      {"from,to,weight\n0,1,nan\n", "w.csv:2: weight: found 'nan'"},
      {"from,to,weight\n0,1,1\n0,1,2\n", "w.csv:3: found a second row for 0 to 1"}};
  for (const auto& [text, expected] : wrong) {
    const auto found = test::message_of<base::BadInput>([&, text = text] { read(text); });
    EXPECT_NE(found.find(expected), std::string::npos) << text << found;
  }
}

TEST(Destinations, UnsuitableNumbersAreRefused) {
  const auto error = [](Pattern pattern, const char* topology) {
    return test::message_of<base::BadInput>([&] { make(pattern, make_topology(topology)); });
  };
  EXPECT_EQ(error(Pattern::transpose, "ring:8"),
            "program.pattern: transpose: found 8 processors, expected a square number");
  EXPECT_EQ(error(Pattern::shuffle, "ring:9"),
            "program.pattern: shuffle: found 9 processors, expected a power of two");
  EXPECT_EQ(error(Pattern::uniform, "line:1"),
            "network.topology: found one processor, expected at least two");
}

// Percentiles of latencies from 1 to 101 s. Each message takes one second longer than the message
// sent before it.
TEST(Latencies, OfKnownSamples) {
  std::vector<observe::Passage> passages;
  for (int i = 1; i <= 101; ++i) passages.push_back({i - 1.0, i * 1.0});
  const auto found = observe::eval_latencies(passages, 0, 100);
  EXPECT_DOUBLE_EQ(*found.p50_s, 51);
  EXPECT_DOUBLE_EQ(*found.p95_s, 96);
  EXPECT_DOUBLE_EQ(*found.p99_s, 100);
  EXPECT_DOUBLE_EQ(*found.longest_s, 101);
  EXPECT_DOUBLE_EQ(*found.drift, 76 / 25.5 - 1);
  EXPECT_NE(describe_drift(found).find("changed by +198 % between"), std::string::npos);
  EXPECT_FALSE(observe::eval_latencies({}, 0, 1).p50_s);
  EXPECT_EQ(describe_drift(observe::eval_latencies({{0, 1}, {1, 1.05}}, 0, 1)), "");
}

}  // namespace
}  // namespace network
