// Several samples per pixel with a lens, area lights and rough surfaces: the image must equal that
// of the sequential renderer.
#include <gtest/gtest.h>

#include "tests/simulator/iirra/iirra_support.hpp"

namespace iirra {
namespace {

Params random_params(std::mt19937_64& random) {
  Params params = small_params();
  params.image.width = 8 + static_cast<int>(random() % 12);
  params.image.height = 8 + static_cast<int>(random() % 12);
  params.image.sampling = test::random_sampling(random);
  params.image.sample = static_cast<renderer::SamplePosition>(random() % 3);
  params.max_cell = 2 << random() % 3;
  params.order = static_cast<CellOrder>(random() % 5);
  params.balance = static_cast<BalanceMethod>(random() % 7);
  params.is_polled = random() % 2;
  if (random() % 2 == 0) {
    Limits limits;
    limits.min_cell = 1 << random() % 3;
    limits.depth_reflected = static_cast<int>(random() % 4);
    limits.min_influence = 0.1 * static_cast<double>(random() % 3);
    params.stages = {limits, Limits{}};
    params.script = {{{0.2}, limits}, {{0.9}, ray_tracing::NonInteractive{}}};
  }
  return params;
}

TEST(IirraSamples, AreTheSequentialRenderers) {
  for (std::uint64_t seed = 1; seed <= 24; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    run_isolated([&] {
      std::mt19937_64 random(seed);
      const Params params = random_params(random);
      const auto scene = test::make_soft_scene();
      const auto result =
          run(params, topologies::make_topology(seed % 3 ? "mesh:3x3" : "line:3"), scene);
      auto expected = render(scene, params.image, 1);
      EXPECT_EQ(result.samples, expected.samples);
      EXPECT_EQ(result.rgb8, make_rgb8(expected.samples));
      // Each worker traces probe rays at the corners it needs, so a corner may be probed more than
      // once.
      EXPECT_GE(result.rays.probes, expected.rays.probes);
      expected.rays.probes = 0;
      EXPECT_EQ(result.rays_image, expected.rays);
    });
  }
}

}  // namespace
}  // namespace iirra
