#include "topologies/graph/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "topologies/make/generators.hpp"

namespace topologies {
namespace {

// For every kind of network, no part is empty, and all parts have nearly equal size.
TEST(Partition, MakesPartsOfNearlyOneSize) {
  for (const char* spec :
       {"line:7", "ring:64", "mesh:16x16", "torus:8x8", "hypercube:4", "tree:40"})
    for (const int parts : {1, 2, 3, 4, 8}) {
      const auto topology = make_topology(spec);
      const auto part_of = make_partition(topology, parts);
      ASSERT_EQ(part_of.size(), static_cast<std::size_t>(topology.processors));
      std::vector<int> sizes(std::ranges::max(part_of) + 1);
      for (const int part : part_of) ++sizes.at(part);
      EXPECT_GE(std::ranges::min(sizes), 1) << spec << ", " << parts;
      if (topology.processors < 10 * parts) continue;
      EXPECT_EQ(sizes.size(), static_cast<std::size_t>(parts)) << spec;
      EXPECT_LE(std::ranges::max(sizes), 1 + 1.2 * topology.processors / parts) << spec;
    }
}

TEST(Partition, CutsFewLinksOfAMesh) {
  const auto mesh = make_topology("mesh:64x64");
  const auto part_of = make_partition(mesh, 2);
  const auto cut = std::ranges::count_if(mesh.links, [&](const Link& link) {
    return part_of[link.a.processor] != part_of[link.b.processor];
  });
  EXPECT_LE(cut, 80);  // the smallest possible number of cut links is 64
  EXPECT_EQ(part_of, make_partition(mesh, 2));
}

TEST(Partition, OfMorePartsThanProcessorsHasOneEach) {
  EXPECT_LE(std::ranges::max(make_partition(make_topology("line:3"), 16)), 2);
  EXPECT_EQ(make_partition(make_topology("line:1"), 4), std::vector{0});
}

}  // namespace
}  // namespace topologies
