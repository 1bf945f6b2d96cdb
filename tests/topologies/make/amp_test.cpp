// Tests the minimum-path network: its links, its distances compared with a lower bound, and its
// reproducibility.
#include "topologies/make/amp.hpp"
#include "tests/topologies/support.hpp"
#include "topologies/graph/metrics.hpp"
#include "topologies/make/generators.hpp"

namespace topologies {
namespace {

// A lower bound on the mean distance of any network with as many links per processor as `t`. A
// processor with d links has at most d other processors at a distance of one link, 3 d at two
// links, and so on. The result is the mean of this bound over all processors.
double least_mean_distance(const Topology& t) {
  double sum = 0;
  for (const auto& around : neighbours(t)) {
    int left = t.processors - 1, width = static_cast<int>(around.size());
    for (int distance = 1; left > 0; ++distance, width *= PORTS - 1) {
      sum += std::min(width, left) * distance;
      left -= std::min(width, left);
    }
  }
  return sum / (t.processors * (t.processors - 1.0));
}

double mean_distance(const Topology& t) { return eval_metrics(t).mean_distance; }

TEST(TopologyAmp, HasEveryLinkItsPortsAllowAndThreeAtTheRoot) {
  for (const int n : {6, 7, 8, 17, 50, 64, 128}) {
    const auto t = make_amp(n);
    EXPECT_EQ(static_cast<int>(t.links.size()), (PORTS * n - 1) / 2) << n;
    EXPECT_EQ(neighbours(t)[0].size(), 3u) << n;
  }
  // every pair of processors has a link
  for (int n = 2; n <= 4; ++n) EXPECT_EQ(mean_distance(make_amp(n)), 1) << n;
  EXPECT_EQ(make_amp(5).links.size(), 9u);  // every pair except one has a link
}

TEST(TopologyAmp, IsNumberedLevelByLevel) {
  for (const int n : {6, 33, 100}) {
    const auto depths = plain_distances(make_amp(n), 0);
    EXPECT_TRUE(std::ranges::is_sorted(depths)) << n;
  }
}

TEST(TopologyAmp, DistancesAreNearTheLeast) {
  for (const int n : {6, 7, 8, 9, 10, 11, 12}) {
    const auto t = make_amp(n);
    EXPECT_NEAR(mean_distance(t), least_mean_distance(t), 1e-12) << n;
  }
  for (const int n : {13, 16, 24, 32, 48, 64, 100, 128, 256}) {
    const auto t = make_amp(n);
    EXPECT_LE(mean_distance(t), 1.04 * least_mean_distance(t)) << n;
  }
}

// A regular network whose root uses all four ports gives up one link of the root, because the
// minimum-path network also leaves a port free for the coordinator of a farm.
TEST(TopologyAmp, IsNeverLongerThanARegularNetworkOfTheSameSize) {
  for (const auto* spec : {"torus:3x3", "torus:3x4", "torus:4x4", "torus:8x8", "hypercube:4",
                           "hypercube:3", "mesh:2x3", "mesh:5x5", "mesh:16x16", "ring:7", "tree:40",
                           "torus:2x6", "torus:16x16", "star:4", "line:6"}) {
    auto other = make_topology(spec);
    if (free_port(other, 0) < 0) other.links.erase(other.links.begin());
    EXPECT_LE(mean_distance(make_amp(other.processors)), mean_distance(other)) << spec;
  }
}

// An FNV-1a hash of the numbers of processors and ports in all links.
std::uint64_t hash_of(const Topology& t) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const auto& [a, b] : t.links)
    for (const int number : {a.processor, a.port, b.processor, b.port})
      hash = (hash ^ static_cast<std::uint64_t>(number)) * 0x100000001b3u;
  return hash;
}

TEST(TopologyAmp, IsTheSameOnEveryMachine) {
  EXPECT_EQ(hash_of(make_amp(6)), 1119954217172707828u);
  EXPECT_EQ(hash_of(make_amp(37)), 14104053000245851856u);
  EXPECT_EQ(hash_of(make_amp(64)), 10679844010219843775u);
  EXPECT_EQ(hash_of(make_amp(100)), 442962877064655500u);
  EXPECT_EQ(hash_of(make_amp(300)), 4091393047156881215u);
}

}  // namespace
}  // namespace topologies
