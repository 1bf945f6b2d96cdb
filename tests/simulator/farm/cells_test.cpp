// Image cells, the orders of sampling them, and the picture on the display. Compares the picture
// with a simple computation.
#include "simulator/farm/rays/cells.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <set>

#include "renderer/scene/generators.hpp"

namespace farm {
namespace {

using renderer::Area;

// Returns a primary ray of the pixel whose number is `sample`.
template <class Sample>
renderer::Ray ray_of(Sample sample) {
  renderer::Ray ray;
  ray.sample = static_cast<std::uint32_t>(sample);
  return ray;
}

constexpr int WIDTH = 29, HEIGHT = 22;
constexpr Area ALL{0, 0, WIDTH, HEIGHT};

Cells random_cells(std::mt19937_64& random) {
  return {.width = WIDTH, .max_cell = 1 << random() % 5};
}

// Returns contributions to random pixels in random order, several for each pixel.
std::vector<std::pair<std::uint32_t, renderer::Rgb>> random_contributions(std::mt19937_64& random) {
  std::vector<std::pair<std::uint32_t, renderer::Rgb>> all;
  const auto share = random() % 100;
  for (std::uint32_t sample = 0; sample < WIDTH * HEIGHT; ++sample) {
    if (random() % 100 > share) continue;
    for (auto n = 1 + random() % 3; n-- > 0;) {
      const auto any = [&] { return static_cast<double>(random() % 1000) / 1000; };
      all.push_back({sample, {any(), any(), any()}});
    }
  }
  std::ranges::shuffle(all, random);
  return all;
}

// The expected picture. Each pixel lies in cells of several sizes. It shows the sample of the
// smallest of these cells that has a sample.
std::vector<std::uint8_t> constant_picture(const renderer::Samples& samples,
                                           const std::set<std::uint32_t>& there,
                                           const Cells& cells) {
  std::vector<std::uint8_t> rgb8(3 * samples.sums.size());
  for (int y = 0; y < HEIGHT; ++y)
    for (int x = 0; x < WIDTH; ++x)
      for (int size = 1; size <= cells.max_cell; size *= 2) {
        const auto sample = static_cast<std::uint32_t>((y - y % size) * WIDTH + x - x % size);
        if (!there.contains(sample)) continue;
        std::ranges::copy(make_rgb8(samples, sample), rgb8.begin() + 3 * (y * WIDTH + x));
        break;
      }
  return rgb8;
}

TEST(FrameBuffer, PaintsWhatNoSmallerCellShows) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const Cells cells = random_cells(random);
    FrameBuffer picture(WIDTH, HEIGHT, cells, CellLight::constant);
    std::set<std::uint32_t> there;
    renderer::Work work;
    for (const auto& [sample, contribution] : random_contributions(random)) {
      const auto before = picture.rgb8();
      const bool is_changed = picture.add(ray_of(sample), contribution, work);
      there.insert(sample);
      EXPECT_EQ(is_changed, picture.rgb8() != before);
    }
    EXPECT_EQ(picture.rgb8(), constant_picture(picture.samples(), there, cells));
  }
}

TEST(FrameBuffer, PointsLightOnePixelEach) {
  std::mt19937_64 random(1);
  FrameBuffer picture(WIDTH, HEIGHT, {.width = WIDTH, .max_cell = 16}, CellLight::point);
  renderer::Work work;
  for (std::uint32_t sample : {0u, 16u, 16u * WIDTH}) picture.add(ray_of(sample), {1, 1, 1}, work);
  EXPECT_EQ(std::ranges::count(picture.rgb8(), 255), 9);
  EXPECT_EQ(work[renderer::Op::pixel_drawn], 3u);
}

// The picture must not depend on the order of arrival of the contributions.
TEST(FrameBuffer, ShowsTheSameInAnyOrder) {
  for (const auto light : {CellLight::constant, CellLight::point, CellLight::smooth})
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", light " << int(light));
      std::mt19937_64 random(seed);
      const Cells cells = random_cells(random);
      auto contributions = random_contributions(random);
      const auto paint = [&] {
        FrameBuffer picture(WIDTH, HEIGHT, cells, light);
        renderer::Work work;
        for (const auto& [sample, colour] : contributions)
          picture.add(ray_of(sample), colour, work);
        return picture.rgb8();
      };
      const auto first = paint();
      std::ranges::shuffle(contributions, random);
      EXPECT_EQ(paint(), first);
    }
}

// If the samples 2 pixels from the corner of a cell arrive before the samples 4 pixels from this
// corner, a cell with a side of 8 pixels shrinks twice at once. The picture must be the same as in
// the usual order of arrival.
TEST(FrameBuffer, SmoothCellsAreRepaintedWhenTheyShrinkTwice) {
  const auto paint = [](std::vector<std::uint32_t> samples) {
    FrameBuffer picture(16, 16, {.width = 16, .max_cell = 8}, CellLight::smooth);
    renderer::Work work;
    for (const auto sample : samples)
      picture.add(ray_of(sample), {sample > 0 ? 0.2 : 1, 0, 0}, work);
    return picture.rgb8();
  };
  EXPECT_EQ(paint({0, 2, 32, 34, 4, 64, 68}), paint({4, 64, 68, 0, 2, 32, 34}));
}

// Cells must be cut off at the border of the rendered area.
TEST(FrameBuffer, PaintsNothingOutsideItsArea) {
  const Area area{5, 3, 10, 9};
  for (const auto light : {CellLight::constant, CellLight::smooth}) {
    FrameBuffer picture(WIDTH, HEIGHT, {.width = WIDTH, .max_cell = 8, .x = 5, .y = 3}, light,
                        area);
    renderer::Work work;
    for (const int y : {3, 11})
      for (const int x : {5, 13}) picture.add(ray_of(y * WIDTH + x), {1, 1, 1}, work);
    EXPECT_EQ(std::ranges::count(picture.rgb8(), 255), 3 * 10 * 9);
  }
}

TEST(FrameBuffer, IsTheImageWhenAllSamplesAreThere) {
  for (const auto light : {CellLight::constant, CellLight::point, CellLight::smooth}) {
    std::mt19937_64 random(7);
    FrameBuffer picture(WIDTH, HEIGHT, {.width = WIDTH, .max_cell = 8}, light);
    renderer::Work work;
    std::vector<std::uint32_t> samples(WIDTH * HEIGHT);
    std::iota(samples.begin(), samples.end(), 0u);
    std::ranges::shuffle(samples, random);
    for (const auto sample : samples)
      picture.add(ray_of(sample), {0.01 * (sample % 97), 0.3, 0.002 * (sample % 400)}, work);
    EXPECT_EQ(picture.rgb8(), make_rgb8(picture.samples()));
  }
}

// The four corners of a cell with a side of 4 pixels have samples, which must yield a linear ramp.
TEST(FrameBuffer, SmoothCellsAreBilinear) {
  FrameBuffer picture(8, 8, {.width = 8, .max_cell = 4}, CellLight::smooth);
  renderer::Work work;
  const double at[2][2] = {{0.2, 0.6}, {0.4, 1.0}};
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x) picture.add(ray_of(32 * y + 4 * x), {at[y][x], 0, 0}, work);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) {
      const double u = x / 4.0, v = y / 4.0;
      const double expected =
          (1 - v) * ((1 - u) * at[0][0] + u * at[0][1]) + v * ((1 - u) * at[1][0] + u * at[1][1]);
      EXPECT_NEAR(picture.rgb8()[static_cast<std::size_t>(3 * (8 * y + x))], 255 * expected, 0.51);
    }
  EXPECT_GT(work[renderer::Op::pixel_interpolated], 16u);
}

// A pixel must show the mean of those of its samples whose primary ray has arrived. At the end,
// this mean equals the sum of the contributions, each with the weight 1 / pixel_samples.
TEST(FrameBuffer, ShowsTheMeanOfSamples) {
  renderer::Sampling sampling;
  sampling.pixel_samples = 4;
  FrameBuffer picture(4, 4, {.width = 4, .max_cell = 1}, CellLight::constant, {}, sampling);
  renderer::Work work;
  for (int pass = 0; pass < 4; ++pass) {
    renderer::Ray ray = ray_of(5);
    ray.pass = static_cast<std::uint16_t>(pass);
    picture.add(ray, {0.12 * (pass + 1) / 4, 0, 0}, work);
    ray.level = 2;  // a contribution of a child ray
    picture.add(ray, {0, 0.2 / 4, 0}, work);
    const double mean = 0.12 * (pass + 2) / 2;
    EXPECT_EQ(picture.rgb8()[15], renderer::make_rgb8(renderer::Rgb{mean, 0, 0})[0]) << pass;
    EXPECT_EQ(picture.rgb8()[16], 51) << pass;
  }
  sampling.adaptive = 0.1;
  sampling.pixel_samples = 32;
  FrameBuffer means(4, 4, {.width = 4, .max_cell = 1}, CellLight::constant, {}, sampling);
  for (const double red : {0.2, 0.6, 0.7}) means.add(ray_of(3), {red, 0, 0}, work);
  EXPECT_NEAR(means.samples().get(3).r, 0.5, 1e-9);
  // finish() replaces the contributions so far by sums of samples with unequal weights.
  renderer::Samples::Sums sums;
  add(sums, renderer::Rgb{3 * 0.6, 0, 0});
  means.finish({3, sums}, work);
  EXPECT_NEAR(means.samples().get(3).r, 0.6, 1e-9);
  EXPECT_EQ(means.rgb8()[9], 153);
}

// Samples of quadrants arrive in any order. Each pixel must have the colour of that quadrant around
// it which comes last in the queue.
TEST(FrameBuffer, PaintsQuadrants) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    const Area area{2, 3, WIDTH - 5, HEIGHT - 4};
    Cells cells{.width = WIDTH, .max_cell = 1};
    const auto order = std::make_shared<const renderer::progressive::QuadrantOrder>(
        renderer::progressive::make_order(area));
    cells.quadrants = order;
    FrameBuffer picture(WIDTH, HEIGHT, cells, CellLight::constant, area);
    std::vector<std::size_t> ranks(order->quadrants.size());
    std::iota(ranks.begin(), ranks.end(), 0);
    std::ranges::shuffle(ranks, random);
    std::vector<int> latest(WIDTH * HEIGHT, -1);
    renderer::Work work;
    for (std::size_t i = 0; i < ranks.size() / 2; ++i) {
      const Area& quadrant = order->quadrants[ranks[i]];
      const auto own = renderer::progressive::own_pixel(quadrant);
      picture.add(ray_of(own.y * WIDTH + own.x), {static_cast<double>(ranks[i] % 256) / 255, 0, 0},
                  work);
      for (int y = quadrant.y; y < quadrant.y + quadrant.height; ++y)
        for (int x = quadrant.x; x < quadrant.x + quadrant.width; ++x) {
          int& owner = latest[static_cast<std::size_t>(y * WIDTH + x)];
          owner = std::max(owner, static_cast<int>(ranks[i]));
        }
    }
    for (std::size_t pixel = 0; pixel < latest.size(); ++pixel)
      ASSERT_EQ(picture.rgb8()[3 * pixel], latest[pixel] < 0 ? 0 : latest[pixel] % 256) << pixel;
  }
}

// The samples of the largest cells, and the samples made by dividing every cell, must together be
// all samples, each exactly once.
TEST(Cells, AreDividedIntoAllSamples) {
  for (const int max_cell : {1, 2, 8, 32}) {
    const Cells cells{.width = WIDTH, .max_cell = max_cell, .order = CellOrder::adaptive};
    std::multiset<std::uint32_t> found;
    for (std::uint32_t s = 0; s < WIDTH * HEIGHT; ++s) {
      if (cells.size_of(s) == max_cell) found.insert(s);
      for (const auto part : cells.divide(s, ALL)) found.insert(part);
    }
    EXPECT_EQ(found.size(), WIDTH * HEIGHT);
    EXPECT_EQ(std::set(found.begin(), found.end()).size(), found.size());
  }
}

TEST(Cells, ComeInTheirOrder) {
  const auto scene = renderer::make_spheres(1);
  renderer::Params params;
  params.width = params.height = 8;
  Cells cells{.width = 8, .max_cell = 4, .order = CellOrder::sequential};
  const auto take = [&] {
    std::vector<std::uint32_t> samples;
    for (const auto& ray : make_initial_rays(scene, params, cells, 1))
      samples.push_back(ray.sample);
    return samples;
  };
  auto all = take();
  using Samples = std::vector<std::uint32_t>;
  EXPECT_EQ(Samples(all.begin(), all.begin() + 7), (Samples{0, 4, 32, 36, 2, 6, 16}));
  cells.order = CellOrder::recursive;
  all = take();
  EXPECT_EQ(Samples(all.begin() + 4, all.begin() + 10), (Samples{2, 16, 18, 6, 20, 22}));
  cells.order = CellOrder::adaptive;
  EXPECT_EQ(take().size(), 4u);
}

// Cells must begin at the corner of the rendered area, so that each of its pixels belongs to a
// cell.
TEST(Cells, BeginAtTheArea) {
  const Cells cells{.width = WIDTH, .max_cell = 8, .x = 5, .y = 3};
  EXPECT_EQ(cells.size_of(3 * WIDTH + 5), 8);
  EXPECT_EQ(cells.size_of(3 * WIDTH + 6), 1);
  EXPECT_EQ(cells.size_of(7 * WIDTH + 9), 4);
  EXPECT_EQ(cells.area_of(11 * WIDTH + 21, {5, 3, 20, 10}), (Area{21, 11, 4, 2}));
}

}  // namespace
}  // namespace farm
