// Tests the cells of progressive rendering: contrast, division, the pyramid test and interpolation.

#include "renderer/progressive/progressive.hpp"

#include <gtest/gtest.h>

#include <atomic>

#include <set>

#include "renderer/progressive/pyramid.hpp"
#include "tests/renderer/support.hpp"

namespace renderer::progressive {
namespace {

using renderer::test::make_params;
using renderer::test::make_random_scene;
using renderer::test::Random;

Samples::Sums at(const Samples& samples, int x, int y) {
  return samples.sums[static_cast<std::size_t>(y * samples.width + x)];
}

TEST(Cells, ContrastEq47) {
  EXPECT_EQ(eval_contrast(0.25, 0.75), 0.5);
  EXPECT_EQ(eval_contrast(0, 0.1), 1);
  EXPECT_EQ(eval_contrast(0.3, 0.3), 0);
  EXPECT_EQ(eval_contrast(0, 0), 0);
  // green has the largest contrast of the three components
  EXPECT_EQ(eval_contrast({{0.5, 0.25, 0.1}, {0.5, 0.75, 0.2}}), 0.5);
}

TEST(Cells, CoverAnyImageOnceDownToPixels) {
  for (const auto& [width, height] : {std::pair(1, 1), {1, 9}, {2, 2}, {17, 17}, {16, 5}, {33, 20}})
    for (const int side : {1, 4, 16}) {
      SCOPED_TRACE(fmt::format("{} x {}, cells of {}", width, height, side));
      std::vector<Cell> cells = make_cells(width, height, side);
      long long area = 0;
      std::set<std::pair<int, int>> corners;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const Cell c = cells[i];
        ASSERT_LE(get_size(c), side);
        if (get_size(c) > 1) {
          const auto parts = divide(c);
          ASSERT_GE(parts.size(), 2u);
          for (const Cell& part : parts) EXPECT_LE(get_size(part), get_size(c) / 2);
          cells.insert(cells.end(), parts.begin(), parts.end());
          continue;
        }
        area += 1LL * (c.x1 - c.x0) * (c.y1 - c.y0);
        for (const int x : {c.x0, c.x1})
          for (const int y : {c.y0, c.y1}) corners.insert({x, y});
      }
      EXPECT_EQ(area, 1LL * (width - 1) * (height - 1));
      EXPECT_EQ(corners.size(), static_cast<std::size_t>(width * height));
    }
}

// One cell of 8 x 8 steps with known colours at its corners. Tests may add a sample in the middle
// of the upper side.
struct OneCell {
  Sampled sampled{9, 9};
  Cell cell{0, 0, 8, 8};

  OneCell() {
    set(0, 0, 0.1);
    set(8, 0, 0.3);
    set(0, 8, 0.5);
    set(8, 8, 0.9);
  }
  void set(int x, int y, double value) {
    const auto i = sampled.index(x, y);
    sampled.levels[i] = 1;
    sampled.samples.sums[i] = {};
    sampled.samples.add(static_cast<std::uint32_t>(i), {value, 2 * value, 0.25});
  }
  double show(int x, int y) const {
    Samples picture = sampled.samples;
    interpolate(cell, sampled, picture);
    return picture.get(static_cast<std::uint32_t>(sampled.index(x, y))).r;
  }
};

TEST(Cells, InterpolationOfFourCornersIsBilinear) {
  const OneCell one;
  for (int y = 0; y <= 8; ++y)
    for (int x = 0; x <= 8; ++x) {
      const double u = x / 8.0, v = y / 8.0;
      EXPECT_NEAR(one.show(x, y),
                  (1 - v) * ((1 - u) * 0.1 + u * 0.3) + v * ((1 - u) * 0.5 + u * 0.9), 1e-9);
    }
}

TEST(Cells, InterpolationPassesThroughEverySampleOnTheBorder) {
  OneCell one;
  one.set(4, 0, 0.8);
  EXPECT_NEAR(one.show(4, 0), 0.8, 1e-9);
  EXPECT_NEAR(one.show(2, 0), 0.45, 1e-9);  // halfway between the values 0.1 and 0.8
  EXPECT_NEAR(one.show(4, 8), 0.7, 1e-9);   // the opposite side does not change
  // bilinear interpolation, plus half of the difference that the sample makes on the upper side
  EXPECT_NEAR(one.show(4, 4), 0.45 + 0.6 / 2, 1e-9);
  const Range range = find_range(one.cell, one.sampled);
  EXPECT_NEAR(range.least.r, 0.1, 1e-9);
  EXPECT_NEAR(range.greatest.g, 1.8, 1e-9);
}

TEST(Cells, NeighboursOfAnySizeAgreeOnTheirBorder) {
  // One cell of side 8 beside four cells of side 4. The right side of the large cell therefore has
  // a sample in the middle.
  Sampled sampled(13, 9);
  Random random{5};
  for (const auto& [x, y] :
       {std::pair(0, 0), {0, 8}, {8, 0}, {8, 4}, {8, 8}, {12, 0}, {12, 4}, {12, 8}}) {
    const auto i = sampled.index(x, y);
    sampled.levels[i] = 1;
    sampled.samples.add(static_cast<std::uint32_t>(i), random.colour());
  }
  Samples left = sampled.samples, right = sampled.samples;
  interpolate({0, 0, 8, 8}, sampled, left);
  interpolate({8, 0, 12, 4}, sampled, right);
  interpolate({8, 4, 12, 8}, sampled, right);
  for (int y = 0; y <= 8; ++y) {
    const auto a = at(left, 8, y), b = at(right, 8, y);
    EXPECT_LE(std::abs(a.r - b.r) + std::abs(a.g - b.g) + std::abs(a.b - b.b), 3) << y;
  }
}

TEST(Progressive, WithoutLimitsTheImageIsTheFullOne) {
  for (const auto& [width, height] : {std::pair(41, 30), {64, 33}, {1, 20}, {17, 1}, {1, 1}}) {
    const Scene scene = make_random_scene(41, 30);
    const Params params = make_params(width, height, 5);
    const Rendering full = render(scene, params);
    for (const int max_cell : {1, 8, 64}) {
      SCOPED_TRACE(fmt::format("{} x {}, cells of {}", width, height, max_cell));
      Progressive image(scene, params, max_cell);
      const auto counts = image.advance({.depth = 5, .area = {}});
      EXPECT_EQ(image.make_picture(), full.samples);
      EXPECT_EQ(counts.rays.fresh, full.rays);
      EXPECT_EQ(counts.rays.work, full.work);
      EXPECT_EQ(counts.rays.repeated, 0u);
    }
  }
}

TEST(Progressive, SamplesHaveTheColoursOfTheFullImageAndOthersAreFilled) {
  const Scene scene = make_random_scene(42, 30);
  const Params params = make_params(50, 40, 5);
  const Rendering full = render(scene, params);
  Progressive image(scene, params, 16, 2);
  for (const int min_cell : {16, 4, 2}) {
    const auto counts =
        image.advance({.contrast = 0.2, .min_cell = min_cell, .depth = 5, .area = {}});
    EXPECT_EQ(counts.cells, image.cells().size());
    const Samples picture = image.make_picture();
    int others = 0;
    for (int y = 0; y < 40; ++y)
      for (int x = 0; x < 50; ++x)
        if (image.sampled().has(x, y)) {
          EXPECT_EQ(at(picture, x, y), at(full.samples, x, y)) << x << ", " << y;
        } else {
          ++others;
        }
    EXPECT_GT(others, 200);
  }
}

TEST(Progressive, NoCellIsLeftAboveTheContrastAndTheSmallestSize) {
  const Scene scene = make_random_scene(43, 30);
  const Params params = make_params(65, 65, 4);
  Progressive image(scene, params, 16);
  image.advance({.contrast = 0.3, .min_cell = 4, .pyramid = false, .depth = 4, .area = {}});
  std::set<int> sizes;
  for (const Cell& cell : image.cells()) {
    sizes.insert(get_size(cell));
    if (get_size(cell) > 4) {
      EXPECT_LE(eval_contrast(find_range(cell, image.sampled())), 0.3);
    }
  }
  EXPECT_EQ(*sizes.begin(), 4);
  EXPECT_GT(sizes.size(), 1u);
}

TEST(Progressive, ThreadsAndRunsDoNotMatter) {
  const Scene scene = make_random_scene(44, 40);
  const Params params = make_params(60, 50, 4);
  const auto run = [&](int threads) {
    Progressive image(scene, params, 16, threads);
    StepCounts all;
    for (const int depth : {1, 2, 4}) {
      const auto counts = image.advance({.contrast = 0.15, .depth = depth, .area = {}});
      all.rays += counts.rays;
      all.by_contrast += counts.by_contrast;
      all.by_pyramid += counts.by_pyramid;
    }
    return std::tuple(image.make_picture(), all.rays.fresh, all.rays.work, all.by_contrast,
                      all.by_pyramid);
  };
  const auto one = run(1);
  EXPECT_GT(std::get<3>(one), 0u);
  EXPECT_EQ(run(3), one);
}

TEST(Progressive, AStepThatIsStoppedHasNoCounts) {
  const Scene scene = make_random_scene(44, 40);
  for (const int threads : {1, 3}) {
    Progressive image(scene, make_params(60, 50, 4), 16, threads);
    std::atomic<int> asked = 0;
    EXPECT_EQ(image.advance({}, [&] { return ++asked > 7; }), std::nullopt);
    EXPECT_LT(asked, 8 + threads);
    EXPECT_GE(asked, 8);
  }
}

TEST(Progressive, OnlyTheAreaOfInterestIsMadeBetter) {
  const Scene scene = make_random_scene(45, 40);
  const Params params = make_params(64, 64, 3);
  const Area area{20, 24, 10, 12};
  Progressive image(scene, params, 16);
  image.advance({.min_cell = 16, .depth = 1, .area = {}});
  const Samples before = image.sampled().samples;
  const auto counts = image.advance({.depth = 3, .area = area});
  const Samples full = render(scene, params).samples, after = image.make_picture();
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x)
      EXPECT_EQ(at(after, x, y), at(full, x, y)) << x << ", " << y;
  EXPECT_EQ(at(image.sampled().samples, 0, 0), at(before, 0, 0));
  EXPECT_EQ(image.cells().front(), (Cell{0, 0, 16, 16}));
  EXPECT_LT(counts.samples + counts.deepened, 2u * 10 * 12);
}

// Makes small spheres and polygons that tests of contrast alone do not find.
Scene make_small_objects(std::uint64_t seed, int objects) {
  Random random{seed};
  Scene scene;
  scene.view.from = {0, 0, 6};
  scene.view.angle = 40;
  scene.background = {0.5, 0.5, 0.5};
  scene.lights.push_back({{2, 3, 6}, {0.1, 0.1, 0.1}});
  scene.surfaces.push_back({.colour = {0.5, 0.5, 0.5}, .kd = 0.1});
  for (int i = 0; i < objects; ++i) {
    const Vec centre = random.point(1.8);
    if (random.below(2) == 0)
      add_sphere(scene, centre, random.range(0.01, 0.08));
    else
      add_polygon(scene, test::make_star(random, centre, random.range(0.02, 0.15)));
  }
  finish(scene);
  return scene;
}

// The objects that are visible at pixels of the complete image.
std::set<std::uint32_t> find_owners(const Scene& scene, const Params& params) {
  std::set<std::uint32_t> owners;
  Work work;
  for (int y = 0; y < params.height; ++y)
    for (int x = 0; x < params.width; ++x)
      if (const auto hit =
              intersect(scene, make_primary(scene.view, params, x, y), Traversal::nearest, work))
        owners.insert(hit->object);
  return owners;
}

std::size_t count_lost(const Scene& scene, const Params& params, Step step) {
  Progressive image(scene, params, 16);
  image.advance(step);
  std::size_t lost = 0;
  for (const auto object : find_owners(scene, params)) lost += !image.is_observed(object);
  return lost;
}

TEST(Pyramid, NoObjectIsLostWhateverTheContrast) {
  std::size_t lost_without = 0, owners = 0;
  for (std::uint64_t seed = 100; seed < 130; ++seed) {
    SCOPED_TRACE(fmt::format("seed {}", seed));
    const Scene scene = make_small_objects(seed, 1 + static_cast<int>(seed) % 40);
    Params params = make_params(70, 50, 2);
    params.sample = static_cast<SamplePosition>(seed % 3);
    owners += find_owners(scene, params).size();
    for (const double contrast : {0.05, 0.4, 1.0})
      EXPECT_EQ(count_lost(scene, params, {.contrast = contrast, .depth = 2, .area = {}}), 0u);
    lost_without +=
        count_lost(scene, params, {.contrast = 1, .pyramid = false, .depth = 2, .area = {}});
  }
  EXPECT_GT(owners, 200u);
  EXPECT_GT(lost_without, 100u);
}

TEST(Pyramid, SavesSamplesWhereNothingHides) {
  const Scene scene = make_small_objects(7, 3);
  const Params params = make_params(128, 128, 1);
  Progressive image(scene, params, 16);
  EXPECT_LT(image.advance({.contrast = 1, .depth = 1, .area = {}}).samples, 128u * 128 / 20);
}

// Takes any ray between the four corners of a pyramid, and any point of this ray. The pyramid must
// meet a small box around this point.
TEST(Pyramid, MeetsWhatARayWithinMeets) {
  Random random{9};
  for (int i = 0; i < 2000; ++i) {
    Scene scene;
    scene.view = {.from = random.point(3),
                  .at = random.point(3),
                  .up = random.direction(),
                  .angle = random.range(5, 170)};
    scene.surfaces.emplace_back();
    add_sphere(scene, random.point(5), 0.1);
    finish(scene);
    const Params params = make_params(32, 32, 1);
    const int x0 = random.below(31), y0 = random.below(31);
    const int x1 = x0 + 1 + random.below(31 - x0), y1 = y0 + 1 + random.below(31 - y0);
    const Pyramid pyramid(scene, make_plane_point(scene.view, params, x0, y0),
                          make_plane_point(scene.view, params, x1, y1));
    const int x = x0 + random.below(x1 - x0 + 1), y = y0 + random.below(y1 - y0 + 1);
    const Ray ray = make_primary(scene.view, params, x, y);
    const Vec point = ray.origin + random.range(0, 9) * ray.direction;
    EXPECT_TRUE(pyramid.may_meet(grow(join(Bounds{}, point), 1e-9))) << i;
    EXPECT_FALSE(pyramid.may_meet(join(Bounds{}, ray.origin - ray.direction))) << i;
  }
}

TEST(Progressive, RefusesWhatItCannotDo) {
  const Scene scene = make_random_scene(46, 3);
  const Params params = make_params(20, 20, 2);
  EXPECT_THROW(Progressive(scene, params, 12), base::BadInput);
  Progressive image(scene, params, 8);
  for (const Step& step : {Step{.contrast = 1.5, .area = {}}, Step{.contrast = -0.1, .area = {}},
                           Step{.min_cell = 3, .area = {}}, Step{.min_cell = 16, .area = {}},
                           Step{.depth = 0, .area = {}}, Step{.area = {15, 0, 6, 6}}})
    EXPECT_THROW(image.advance(step), base::BadInput);
}

}  // namespace
}  // namespace renderer::progressive
