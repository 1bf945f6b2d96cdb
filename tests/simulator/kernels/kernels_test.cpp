// Sizes of the kernels' records in simulated memory.
#include "simulator/kernels/kernels.hpp"

#include <gtest/gtest.h>

#include "tests/support/lab.hpp"

namespace kernels {
namespace {

TEST(KernelBytes, OfTexturesAreThoseOfAllTheirTexels) {
  const auto model = machine::load_model("t805-25");
  renderer::Scene scene;
  EXPECT_EQ(texture_bytes(model, scene), 0u);
  std::uint64_t texels = 0;
  for (const auto& [width, height] : {std::pair(1, 1), {4, 2}, {7, 5}}) {
    const std::vector<std::uint8_t> rgb8(static_cast<std::size_t>(3 * width * height));
    scene.pyramids.push_back(renderer::make_pyramid(width, height, rgb8));
    texels += texel_count(scene.pyramids.back());
    EXPECT_GE(texels, static_cast<std::uint64_t>(width * height));
    EXPECT_EQ(texture_bytes(model, scene), texels * get_bytes(model, "texel"));
  }
}

// The clock can measure each of these calls. The profile is therefore the sum of their durations,
// each less the time of reading the clock.
TEST(KernelProfile, IsTheTimeOfAllLongCalls) {
  constexpr int CALLS = 3;
  const double call_s = 4 * KernelTimer::LEAST_INTERVALS * clock_interval_s();
  const auto found = occam::isolated_numbers([&] {
    occam::Lab lab(occam::REAL_MODEL);
    KernelCost cost("wait", {occam::REAL_MODEL, &intersection_costs}, std::nullopt, true);
    lab.cpu().start("caller", machine::Priority::low, [&] {
      for (int i = 0; i < CALLS; ++i)
        cost([&](renderer::Work&) {
          const double start_s = host_cpu_s();
          while (host_cpu_s() - start_s < call_s) continue;
          return true;
        });
    });
    lab.machine.run();
    return occam::Numbers{cost.profile_s()};
  });
  EXPECT_GE(found.at(0), CALLS * (call_s - clock_interval_s()));
}

}  // namespace
}  // namespace kernels
