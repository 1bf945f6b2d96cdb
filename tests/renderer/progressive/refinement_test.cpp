// Tests progressive refinement: two passes over the pixels, and interruptions between steps.
#include "renderer/progressive/refinement.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"

namespace renderer {
namespace {

using progressive::Order;
using progressive::Refinement;

Params make_sampled(int width, int height, int samples, double adaptive = 0) {
  Params params = test::make_params(width, height, 3);
  params.sampling.pixel_samples = samples;
  params.sampling.adaptive = adaptive;
  return params;
}

void finish(Refinement& image) {
  while (!image.is_finished()) image.advance(image.total());
}

void expect_equal(const Rendering& found, const Rendering& expected) {
  EXPECT_EQ(found.samples, expected.samples);
  EXPECT_EQ(found.counts, expected.counts);
  EXPECT_EQ(found.rays, expected.rays);
  EXPECT_EQ(found.work, expected.work);
}

TEST(Refinement, EndsWithThePictureAndTheCountsOfRender) {
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const Scene scene = test::make_random_scene(seed, 12);
    for (const double adaptive : {0.0, 0.05})
      for (const int samples : {1, 2, 5, 40}) {
        Params params = make_sampled(23, 14, samples, adaptive);
        if (seed == 2) params.area = {3, 2, 17, 9};
        const auto expected = render(scene, params);
        for (const Order order : {Order::scan, Order::quadrants})
          for (const int threads : {1, 3}) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << samples << " samples, "
                                            << adaptive << ", " << threads << " threads");
            Refinement image(scene, params, order, threads);
            finish(image);
            EXPECT_EQ(image.done(), image.total());
            expect_equal(image.make_rendering(), expected);
            expect_equal(image.take_rendering(), expected);
          }
      }
  }
}

// A rendering advances in steps of any size and stops somewhere. A second rendering continues from
// its state, and must end with the picture of render().
TEST(Refinement, StoppedAnywhereItGoesOnToTheSamePicture) {
  const Scene scene = test::make_random_scene(7, 10);
  for (const auto& [samples, adaptive] : {std::pair{6, 0.0}, {20, 0.05}}) {
    const Params params = make_sampled(19, 13, samples, adaptive);
    const auto expected = render(scene, params);
    for (std::uint64_t seed = 1; seed <= 100; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", adaptive " << adaptive);
      test::Random random{seed};
      const Order order = random.below(2) ? Order::scan : Order::quadrants;
      Refinement begun(scene, params, order, 1 + random.below(3));
      const auto stop = static_cast<std::uint64_t>(random.below(19 * 13 * samples + 1));
      while (begun.done() < stop) begun.advance(1 + static_cast<std::uint64_t>(random.below(200)));
      Refinement resumed(scene, params, order, 1 + random.below(3), begun.state());
      expect_equal(resumed.make_rendering(), begun.make_rendering());
      finish(resumed);
      expect_equal(resumed.make_rendering(), expected);
    }
  }
}

TEST(Refinement, ItStopsAtTheFirstPixelThatReachesTheNumber) {
  const Scene scene = test::make_random_scene(3, 8);
  const Params params = make_sampled(11, 9, 5);
  for (const std::uint64_t goal : {1u, 40u, 99u, 100u, 101u, 300u, 495u}) {
    Refinement at_once(scene, params, Order::quadrants), in_steps(scene, params, Order::quadrants);
    while (at_once.done() < goal) at_once.advance(goal - at_once.done());
    while (in_steps.done() < goal)
      in_steps.advance(std::min<std::uint64_t>(7, goal - in_steps.done()));
    const std::uint64_t expected = goal <= 99 ? goal : 99 + (goal - 99 + 3) / 4 * 4;
    EXPECT_EQ(at_once.done(), expected);
    EXPECT_EQ(in_steps.done(), expected);
    expect_equal(in_steps.make_rendering(), at_once.make_rendering());
  }
}

// Every sample must be taken only once.
TEST(Refinement, EverySampleThatIsDoneWasOnePrimaryRay) {
  const Scene scene = test::make_random_scene(5, 8);
  Refinement image(scene, make_sampled(13, 7, 4), Order::quadrants);
  while (!image.is_finished()) {
    image.advance(5);
    ASSERT_EQ(image.state().rays.primary, image.done());
  }
}

TEST(Refinement, InTheFirstPassBlocksHaveTheColourOfTheirPixel) {
  const Scene scene = test::make_random_scene(4, 8);
  const Params params = make_sampled(10, 6, 1);
  const auto whole = render(scene, params);
  Refinement image(scene, params, Order::quadrants);
  progressive::QuadrantQueue queue({0, 0, 10, 6});
  Samples expected(10, 6);
  while (const auto block = queue.next()) {
    image.advance(1);
    const auto own = progressive::own_pixel(*block);
    for (int y = block->y; y < block->y + block->height; ++y)
      for (int x = block->x; x < block->x + block->width; ++x)
        expected.sums[static_cast<std::size_t>(y * 10 + x)] =
            whole.samples.sums[static_cast<std::size_t>(own.y * 10 + own.x)];
    ASSERT_EQ(image.make_rendering().samples, expected) << image.done();
  }
  EXPECT_TRUE(image.is_finished());
}

// In the second pass, a pixel keeps the colour of its first sample until all its samples are taken.
TEST(Refinement, InTheSecondPassPixelsChangeOneByOne) {
  const Scene scene = test::make_random_scene(6, 8);
  const int samples = 4;
  const Params params = make_sampled(9, 8, samples);
  const auto whole = render(scene, params);
  SampleTracer tracer(scene, params);
  Samples expected(9, 8);
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 9; ++x)
      for (int i = 0; i < samples; ++i)
        add(expected.sums[static_cast<std::size_t>(y * 9 + x)], tracer.trace(x, y, 0).sums);
  Refinement image(scene, params, Order::quadrants);
  image.advance(72);
  EXPECT_EQ(image.make_rendering().samples, expected);
  progressive::QuadrantQueue queue({0, 0, 9, 8});
  while (const auto block = queue.next()) {
    image.advance(1);
    const auto own = progressive::own_pixel(*block);
    const auto at = static_cast<std::size_t>(own.y * 9 + own.x);
    expected.sums[at] = whole.samples.sums[at];
    ASSERT_EQ(image.make_rendering().samples, expected) << image.done();
  }
}

TEST(Refinement, PixelsOfAScanAreBlackUntilTheyAreTraced) {
  Scene scene = test::make_random_scene(2, 8);
  scene.background = {0.2, 0.4, 0.6};
  const Params params = make_sampled(8, 8, 1);
  const auto whole = render(scene, params);
  Refinement image(scene, params, Order::scan);
  image.advance(19);
  const auto found = image.make_rendering();
  for (std::size_t i = 0; i < 64; ++i)
    EXPECT_EQ(found.samples.sums[i], i < 19 ? whole.samples.sums[i] : Samples::Sums{}) << i;
  EXPECT_EQ(image.queue(), nullptr);
}

TEST(Refinement, AStateOfAnotherSizeIsRefused) {
  const Scene scene = test::make_random_scene(1, 4);
  Refinement small(scene, make_sampled(8, 8, 2), Order::scan);
  const auto resume = [&](const Params& params, const progressive::RefinementState& state) {
    Refinement resumed(scene, params, Order::scan, 1, state);
  };
  EXPECT_THROW(resume(make_sampled(8, 9, 2), small.state()), base::BadInput);
  // This rendering has a fixed number of samples: the largest number that the adaptive rendering
  // may take.
  Refinement fixed(scene, make_sampled(8, 8, 20), Order::scan);
  EXPECT_THROW(resume(make_sampled(8, 8, 20, 0.1), fixed.state()), base::BadInput);
  auto state = small.state();
  state.done = 8 * 8 * 2 + 1;
  EXPECT_THROW(resume(make_sampled(8, 8, 2), state), base::BadInput);
  EXPECT_THROW(Refinement(scene, make_sampled(8, 8, 2), Order::scan, 0), base::BadInput);
}

}  // namespace
}  // namespace renderer
