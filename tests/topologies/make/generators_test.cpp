#include "topologies/make/generators.hpp"

#include "tests/topologies/support.hpp"

namespace topologies {
namespace {

class TopologyGenerated : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Of, TopologyGenerated, testing::ValuesIn(SPECS), SpecName());

TEST_P(TopologyGenerated, IsValidAndNamedAfterItsSpec) {
  const auto t = make_topology(GetParam());
  EXPECT_NO_THROW(check(t));
  EXPECT_EQ(t.name, GetParam());
  EXPECT_EQ(t.root, 0);
}

TEST_P(TopologyGenerated, PortsAreUniqueAndAgreeAtBothEnds) {
  const auto t = make_topology(GetParam());
  const auto around = neighbours(t);
  for (int p = 0; p < t.processors; ++p) {
    std::vector<bool> used(PORTS, false);
    for (const auto& n : around[p]) {
      ASSERT_TRUE(n.port >= 0 && n.port < PORTS);
      EXPECT_FALSE(used[n.port]) << "port " << n.port << " of " << p;
      used[n.port] = true;
      const auto back = std::ranges::find(around[n.processor], p, &Neighbour::processor);
      ASSERT_NE(back, around[n.processor].end());
      EXPECT_EQ(std::pair(back->port, back->its_port), std::pair(n.its_port, n.port));
      EXPECT_EQ(back->link, n.link);
      const auto& [a, b] = t.links.at(n.link);
      EXPECT_EQ(p < n.processor ? a : b, (End{p, n.port}));
    }
    const auto unused = std::ranges::find(used, false);
    EXPECT_EQ(free_port(t, p), unused == used.end() ? -1 : unused - used.begin());
  }
}

TEST_P(TopologyGenerated, RootKeepsPortZeroWhenItHasAFreePort) {
  const auto t = make_topology(GetParam());
  const bool full = neighbours(t)[0].size() == PORTS;
  EXPECT_EQ(free_port(t, 0), full ? -1 : 0);
}

// The trees of thesis figure 4.21 for 1 to 7 workers, and the trees for more workers. The parents
// of a level get the workers of the next level in turn.
TEST(TopologyTree, ParentsAreThoseOfFigure421) {
  const std::vector<int> parents{-1, 0, 0, 0, 1, 2, 3, 1, 2, 3, 1, 2, 3, 4, 5, 6};
  for (int n = 1; n <= 16; ++n) {
    const auto around = neighbours(make_tree(n));
    for (int p = 1; p < n; ++p) {
      EXPECT_EQ(around[p][0].port, 0);
      EXPECT_EQ(around[p][0].processor, parents[p]) << "of " << p << " among " << n;
    }
  }
}

class TopologyBalance : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(OfArity, TopologyBalance, testing::Values(1, 2, 3));

// The parents of a level get the processors of the next level in turn. Subtrees of siblings
// therefore differ by at most one processor.
TEST_P(TopologyBalance, SiblingsDifferByOneProcessorAtMost) {
  for (int n = 1; n <= 40; ++n) {
    const auto around = neighbours(make_tree(n, GetParam()));
    std::vector<int> size(n, 1);
    for (int p = n - 1; p > 0; --p) size[around[p][0].processor] += size[p];
    for (int p = 0; p < n; ++p) {
      std::vector<int> children;
      for (const auto& neighbour : around[p])
        if (neighbour.port > 0) children.push_back(size[neighbour.processor]);
      ASSERT_LE(static_cast<int>(children.size()), GetParam());
      if (children.empty()) continue;
      const auto [fewest, most] = std::ranges::minmax(children);
      EXPECT_LE(most - fewest, 1) << "under " << p << " of " << n;
    }
  }
}

TEST(TopologyGenerators, EveryFormIsListedAndItsNameUnderstood) {
  EXPECT_GE(generators().size(), 8u);
  for (const auto& generator : generators()) {
    EXPECT_TRUE(generator.form.starts_with(generator.name() + ":"));
    EXPECT_FALSE(generator.help.empty());
    const auto smallest = generator.name() + (generator.form.ends_with("RxC") ? ":3x3" : ":3");
    EXPECT_EQ(make_topology(smallest).name, smallest);
  }
}

TEST(TopologyGenerators, ShapesAreKept) {
  const auto mesh = make_topology("mesh:4x6"), torus = make_torus(2, 5);
  EXPECT_EQ(mesh.shape.form, Shape::Form::grid);
  EXPECT_EQ(mesh.shape.rows, 4);
  EXPECT_EQ(mesh.shape.columns, 6);
  EXPECT_EQ(torus.shape.form, Shape::Form::grid);
  EXPECT_EQ(torus.shape.columns, 5);
  EXPECT_EQ(make_topology("amp:6").shape.form, Shape::Form::around_root);
  EXPECT_EQ(make_tree(7).shape.form, Shape::Form::unknown);
}

TEST(TopologyGenerators, LargestIsMade) {
  EXPECT_EQ(make_topology("mesh:256x256").processors, MAX_PROCESSORS);
  EXPECT_EQ(make_topology("tree:65536").links.size(), 65535u);
}

}  // namespace
}  // namespace topologies
