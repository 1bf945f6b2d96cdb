// Tests the topological sort of a dependency graph.
#include "base/order.hpp"

#include <gtest/gtest.h>

namespace base {
namespace {

using Indices = std::vector<std::size_t>;

TEST(Order, WhatIsNeededComesFirst) {
  EXPECT_EQ(sort_by_needs({}).sorted, Indices());
  EXPECT_EQ(sort_by_needs({{2, 1}, {}, {3, 1}, {}}).sorted, (Indices{3, 1, 2, 0}));
  EXPECT_TRUE(sort_by_needs({{2, 1}, {}, {3, 1}, {}}).circle.empty());
}

TEST(Order, ACircleIsNamed) {
  EXPECT_EQ(sort_by_needs({{0}}).circle, Indices{0});
  EXPECT_EQ(sort_by_needs({{1}, {2}, {3}, {4, 1}, {}}).circle, (Indices{1, 2, 3}));
}

TEST(Order, NeedsMayBeDeep) {
  constexpr std::size_t DEPTH = 1'000'000;
  std::vector<Indices> needs(DEPTH);
  for (std::size_t i = 0; i + 1 < DEPTH; ++i) needs[i] = {i + 1};
  const auto sorted = sort_by_needs(needs).sorted;
  ASSERT_EQ(sorted.size(), DEPTH);
  for (std::size_t i = 0; i < DEPTH; ++i) ASSERT_EQ(sorted[i], DEPTH - 1 - i);
}

}  // namespace
}  // namespace base
