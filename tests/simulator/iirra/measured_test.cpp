// Bottlenecks of IIRRA runs.
#include "simulator/iirra/measured.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/simulator/iirra/iirra_support.hpp"

namespace iirra {
namespace {

TEST(IirraBottleneck, IsTheBusiestOfAllResources) {
  run_isolated([] {
    const auto loads = find_loads(run(small_params(), "mesh:3x3"));
    ASSERT_FALSE(loads.empty());
    std::set<std::string> resources;
    for (const auto& load : loads) {
      EXPECT_GE(load.busy, 0) << load.resource;
      EXPECT_LE(load.busy, loads[0].busy) << load.resource;
      resources.insert(load.resource);
    }
    EXPECT_LE(loads[0].busy, 1);
    for (const char* resource : {"workers", "coordination", "tasks"})
      EXPECT_TRUE(resources.contains(resource)) << resource;
  });
}

}  // namespace
}  // namespace iirra
