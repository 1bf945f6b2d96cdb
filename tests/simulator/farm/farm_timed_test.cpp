// The farm with costs from host timings: which kernels are timed, and that repeating a kernel's
// calls for the timing changes no result.
#include <gtest/gtest.h>

#include <map>

#include "renderer/scene/generators.hpp"
#include "simulator/farm/shared_farm.hpp"
#include "tests/simulator/farm/farm_support.hpp"
#include "topologies/make/generators.hpp"

namespace farm {
namespace {

Setup timed_setup(const std::string& topology) {
  static const auto model = machine::load_model("t805-25");
  return {
      .model = model, .topology = topologies::make_topology(topology), .cycles_per_host_s = 1e9};
}

std::map<std::string, std::uint64_t> calls_of(const Result& result) {
  std::map<std::string, std::uint64_t> calls;
  for (const auto& kernel : result.kernels) {
    calls[kernel.name] = kernel.calls;
    EXPECT_GT(kernel.counted.value, 0) << kernel.name;
    // A cycle stands for one nanosecond here, and the time of each call is rounded to whole cycles.
    EXPECT_NEAR(double(kernel.charged.value), kernel.host_s * 1e9, double(kernel.calls))
        << kernel.name;
  }
  return calls;
}

using Calls = std::map<std::string, std::uint64_t>;

TEST(FarmTimed, RaysShadingAndDisplayAreTimed) {
  const auto scene = make_glass_scene();
  run_isolated([&] {
    const auto params = small_params();
    const auto oracle = renderer::render(scene, params.image);
    const auto farm = run_farm(timed_setup("tree:3"), scene, params);
    EXPECT_TRUE(farm.samples == oracle.samples);
    EXPECT_TRUE(farm.rays == oracle.rays);
    const auto hits = oracle.work[renderer::Op::surface_shaded];
    auto calls = calls_of(farm);
    // A call for an occluded shadow feeler shades no surface, so there may be more calls than
    // shaded surfaces.
    EXPECT_GE(calls["shading"], hits);
    calls.erase("shading");
    EXPECT_EQ(calls, (Calls{{"ray", oracle.rays.total()}, {"display", oracle.rays.total()}}));
  });
}

TEST(FarmTimed, BlocksAreTimed) {
  const auto scene = make_glass_scene();
  run_isolated([&] {
    auto params = small_params();
    params.block = Block{8, 6};
    const auto blocks = make_blocks(params.image, *params.block).size();
    const auto farm = run_farm(timed_setup("line:2"), scene, params);
    EXPECT_TRUE(farm.samples == renderer::render(scene, params.image).samples);
    EXPECT_EQ(calls_of(farm), (Calls{{"block", blocks}, {"display", blocks}}));
  });
}

// While a block is rendered, it waits for scene data. It must be charged as much as if all data had
// been present.
TEST(FarmTimed, BlocksThatWaitForDataAreTimed) {
  const auto scene = renderer::make_spheres(20);
  run_isolated([&] {
    auto params = small_params();
    params.block = Block{8, 6};
    const auto blocks = make_blocks(params.image, *params.block).size();
    SharedParams data;
    data.cache_percent = 30;
    const auto shared = run_shared_farm(timed_setup("line:2"), scene, params, data);
    EXPECT_TRUE(shared.farm.samples == renderer::render(scene, params.image).samples);
    EXPECT_EQ(calls_of(shared.farm), (Calls{{"block", blocks}, {"display", blocks}}));
    const auto& block = shared.farm.kernels.front();
    EXPECT_EQ(block.name, "block");
    EXPECT_NEAR(double(shared.farm.kernel_cycles.value), double(block.charged.value),
                3.0 * double(blocks));
    EXPECT_GT(shared.shared.data.accesses(), 0u);
  });
}

TEST(FarmTimed, CountedKernelsAreNotTimed) {
  const auto scene = make_glass_scene();
  run_isolated([&] {
    const auto farm =
        run_farm({machine::load_model("t805-25"), topologies::make_topology("line:1")}, scene,
                 small_params());
    for (const auto& kernel : farm.kernels) {
      EXPECT_EQ(kernel.host_s, 0) << kernel.name;
      EXPECT_EQ(kernel.counted, kernel.charged) << kernel.name;
    }
    EXPECT_EQ(farm.kernels.size(), 3u);
  });
}

}  // namespace
}  // namespace farm
