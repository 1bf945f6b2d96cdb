// Tests adaptive sampling: pixels that need more samples get them.
#include "renderer/trace/adaptive.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>

#include "renderer/scene/generators.hpp"
#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

Params make_adaptive(int side, double error, int most = 256) {
  Params params = make_params(side, side, 5);
  params.limits.min_influence = 0.01;
  params.sampling.pixel_samples = most;
  params.sampling.adaptive = error;
  return params;
}

SquarePoint sample(const Params& params, int pass, Dimension dimension, std::uint32_t pixel) {
  return sample_square(params.sampling, {pixel, pass}, dimension);
}

// The index of the rectangle that contains a point, if the unit square is divided into columns x
// rows.
int find_part(const SquarePoint& at, int columns, int rows) {
  return static_cast<int>(at.v * rows) * columns + static_cast<int>(at.u * columns);
}

TEST(Adaptive, RoundsDoubleTheSamples) {
  const Params params = make_adaptive(1, 0.1, 100);
  std::vector<int> ends;
  for (int pass = 0; pass < 100;) {
    const Round round = round_of(params.sampling, pass);
    EXPECT_EQ(round.first, pass);
    ends.push_back(pass += round.count);
  }
  EXPECT_EQ(ends, (std::vector<int>{16, 32, 64, 100}));
}

// The sample's point in the unit square of its group. For Dimension::pixel, the square of each
// group is a quarter of the pixel.
SquarePoint sample_in_group(const Params& params, int group, int place, Dimension dimension,
                            std::uint32_t pixel) {
  const auto at = sample(params, GROUPS * place + group, dimension, pixel);
  if (dimension != Dimension::pixel) return at;
  return {2 * at.u - std::floor(2 * at.u), 2 * at.v - std::floor(2 * at.v)};
}

// If the square is divided into as many equal rectangles as a group has samples, each rectangle
// must contain one sample. For Dimension::pixel, this is true for any power of two; for other
// dimensions, after whole rounds.
TEST(Adaptive, RectanglesOfAllShapesHaveASampleEach) {
  const Params params = make_adaptive(1, 0.1, 1000);
  for (const auto dimension : {Dimension::pixel, Dimension::lens, Dimension::gloss})
    for (std::uint32_t pixel = 0; pixel < 30; ++pixel)
      for (int group = 0; group < GROUPS; ++group)
        for (const int count : {2, 4, 8, 16, 32, 64, 128}) {
          if (dimension != Dimension::pixel && count == 2) continue;  // not a whole round
          for (int columns = 1; columns <= count; columns *= 2) {
            std::set<int> parts;
            for (int place = 0; place < count; ++place)
              parts.insert(find_part(sample_in_group(params, group, place, dimension, pixel),
                                     columns, count / columns));
            EXPECT_EQ(parts.size(), static_cast<std::size_t>(count));
          }
        }
}

TEST(Adaptive, GroupsHaveAQuarterOfThePixelEach) {
  const Params params = make_adaptive(1, 0.1, 256);
  std::set<int> first;
  for (std::uint32_t pixel = 0; pixel < 50; ++pixel) {
    std::map<int, std::set<int>> quarters;
    for (int pass = 0; pass < 256; ++pass)
      quarters[group_of(pass)].insert(
          find_part(sample(params, pass, Dimension::pixel, pixel), 2, 2));
    std::set<int> all;
    for (const auto& [group, found] : quarters) {
      EXPECT_EQ(found.size(), 1u);
      all.insert(*found.begin());
    }
    EXPECT_EQ(all.size(), 4u);
    first.insert(*quarters[0].begin());
  }
  EXPECT_EQ(first.size(), 4u);
}

TEST(Adaptive, TheSequenceSaysWhichSamplesShareASquare) {
  const Params params = make_adaptive(1, 0.1, 256);
  for (std::uint32_t pixel = 0; pixel < 50; ++pixel)
    for (int levels = 0; levels < 4; ++levels) {
      std::map<int, std::set<int>> squares;
      for (int pass = 0; pass < 256; ++pass) {
        const auto [u, v] = eval_pixel_sequence(pass);
        const int part = find_part({0x1p-32 * u, 0x1p-32 * v}, 1 << levels, 1 << levels);
        squares[part].insert(
            find_part(sample(params, pass, Dimension::pixel, pixel), 1 << levels, 1 << levels));
      }
      EXPECT_EQ(squares.size(), std::size_t{1} << (2 * levels));
      for (const auto& [part, found] : squares) EXPECT_EQ(found.size(), 1u);
    }
}

TEST(Adaptive, TimesAreSpreadEvenlyToo) {
  const Params params = make_adaptive(1, 0.1, 256);
  for (std::uint32_t pixel = 0; pixel < 20; ++pixel)
    for (int group = 0; group < GROUPS; ++group)
      for (const int count : {4, 8, 16, 64}) {
        std::set<int> parts;
        for (int place = 0; place < count; ++place) {
          const SampleKey key{pixel, GROUPS * place + group};
          parts.insert(
              static_cast<int>(sample_line(params.sampling, key, Dimension::time) * count));
        }
        EXPECT_EQ(parts.size(), static_cast<std::size_t>(count));
      }
}

TEST(Adaptive, EachSampleIsAnywhereInItsSquare) {
  // Over many pixels, every sample must be uniformly distributed in its pixel. The mean of any
  // number of samples is then unbiased.
  const Params params = make_adaptive(1, 0.1, 64);
  for (const int pass : {0, 1, 7, 40}) {
    double u = 0, v = 0, uv = 0;
    constexpr int PIXELS = 20000;
    for (std::uint32_t pixel = 0; pixel < PIXELS; ++pixel) {
      const auto at = sample(params, pass, Dimension::pixel, pixel);
      u += at.u / PIXELS;
      v += at.v / PIXELS;
      uv += at.u * at.v / PIXELS;
    }
    EXPECT_NEAR(u, 0.5, 0.01);
    EXPECT_NEAR(v, 0.5, 0.01);
    EXPECT_NEAR(uv, 0.25, 0.01);
  }
}

TracedSample make_sample(double grey, std::uint32_t object = 7) {
  TracedSample traced;
  add(traced.sums, Rgb{grey, grey, grey});
  traced.object = object;
  return traced;
}

int find_wanted(double error, const std::vector<TracedSample>& samples, std::uint32_t corner) {
  return find_wanted(make_adaptive(1, error).sampling, samples, {corner, corner, corner, corner});
}

TEST(Adaptive, ABorderHasASecondRound) {
  for (const std::uint32_t object : {std::uint32_t{7}, NO_OBJECT}) {
    std::vector<TracedSample> samples(16, make_sample(0.5, object));
    EXPECT_EQ(find_wanted(0.1, samples, object), 16);
    EXPECT_EQ(find_wanted(0.1, samples, 8), 32);
    samples[9].object = 8;
    EXPECT_EQ(find_wanted(0.1, samples, object), 32);
    samples.resize(32, make_sample(0.5, object));
    EXPECT_EQ(find_wanted(0.1, samples, object), 32);
  }
}

TEST(Adaptive, TheErrorIsWhatSquaresDoNotExplain) {
  // Half of the quarters are white and half are black; none is mixed. The estimated error is
  // therefore 0.
  std::vector<TracedSample> samples;
  for (int i = 0; i < 16; ++i) samples.push_back(make_sample(group_of(i) % 2));
  EXPECT_EQ(find_wanted(1e-6, samples, 7), 16);
  // Each quarter has one white and three black samples, and hence the variance 1/4. The variance of
  // the mean is 1/16 of that, which is 0.125 squared.
  samples.clear();
  std::set<int> seen;
  for (int i = 0; i < 16; ++i)
    samples.push_back(make_sample(seen.insert(group_of(i)).second ? 1 : 0));
  // The error allowed after 16 samples is half of that allowed after 64.
  EXPECT_EQ(find_wanted(0.252, samples, 7), 16);
  EXPECT_EQ(find_wanted(0.248, samples, 7), 32);
  // Colours brighter than white count as white.
  for (TracedSample& s : samples) s = make_sample(s.sums.r > 0 ? 50 : 1);
  EXPECT_EQ(find_wanted(1e-6, samples, 7), 16);
}

TEST(Adaptive, AGroupIsFinishedByTheOthers) {
  const Sampling sampling = make_adaptive(1, 0.02).sampling;
  const Corners nothing{NO_OBJECT, NO_OBJECT, NO_OBJECT, NO_OBJECT};
  std::vector<TracedSample> samples(16, make_sample(0, NO_OBJECT));
  samples[1] = make_sample(1, 3);
  EXPECT_EQ(find_kept(sampling, samples, nothing), (Kept{0, 16, 0, 0}));
  EXPECT_EQ(find_wanted(sampling, samples, nothing), 32);
  samples.resize(32, make_sample(0, NO_OBJECT));
  EXPECT_EQ(find_kept(sampling, samples, nothing), (Kept{0, 16, 0, 0}));
  samples.resize(64, make_sample(0, NO_OBJECT));
  EXPECT_EQ(find_kept(sampling, samples, nothing), (Kept{64, 16, 64, 64}));
  EXPECT_EQ(find_wanted(sampling, samples, nothing), 64);
  // Group 1 keeps four samples, one of which is a hit.
  EXPECT_EQ(to_rgb(eval_estimate(sampling, samples, nothing)).r, 1.0 / 16);
}

double eval_rmse(const Samples& a, const Samples& b, const Area& area) {
  double sum = 0;
  for (int y = area.y; y < area.y + area.height; ++y)
    for (int x = area.x; x < area.x + area.width; ++x)
      for (const auto component : {&Rgb::r, &Rgb::g, &Rgb::b}) {
        const auto get = [&](const Samples& samples) {
          const auto at = static_cast<std::uint32_t>(y * samples.width + x);
          return std::clamp(samples.get(at).*component, 0.0, 1.0);
        };
        sum += (get(a) - get(b)) * (get(a) - get(b));
      }
  return std::sqrt(sum / (3.0 * area.width * area.height));
}

TEST(Adaptive, SavesRaysAtTheSameError) {
  // A part of a larger image that has many borders of objects. (docs/manual compares whole images.)
  const Scene scene = make_spheres(200);
  Params params = make_adaptive(512, 0);
  params.area = {200, 210, 32, 32};
  const auto run = [&](int samples, double error, std::uint64_t seed) {
    params.sampling = {.pixel_samples = samples, .adaptive = error, .seed = seed};
    return render(scene, params);
  };
  const Rendering reference = run(400, 0, 99), uniform = run(64, 0, 1), found = run(256, 0.014, 1);
  EXPECT_LT(eval_rmse(found.samples, reference.samples, params.area),
            eval_rmse(uniform.samples, reference.samples, params.area));
  EXPECT_LT(found.rays.total(), 0.7 * uniform.rays.total());
}

// By pixel: true if a grid of rays in it meets several objects, or an object and the background.
std::vector<bool> find_borders(const Scene& scene, const Params& params, int grid) {
  Params fine = params;
  fine.sampling = {};
  fine.width *= grid;
  fine.height *= grid;
  fine.sample = SamplePosition::center;
  std::vector<bool> borders;
  Work work;
  for (int y = 0; y < params.height; ++y)
    for (int x = 0; x < params.width; ++x) {
      std::set<std::uint32_t> objects;
      for (int i = 0; i < grid * grid && objects.size() < 2; ++i) {
        const Ray ray = make_primary(scene.view, fine, x * grid + i % grid, y * grid + i / grid);
        const auto hit = intersect(scene, ray, fine.traversal, work);
        objects.insert(hit ? hit->object : NO_OBJECT);
      }
      borders.push_back(objects.size() > 1);
    }
  return borders;
}

// The number of pixels at borders of objects, and the number of those of them that have at most
// `most` samples.
std::pair<int, int> count_borders(const Scene& scene, const Params& params, int most) {
  const auto borders = find_borders(scene, params, 10);
  const Rendering found = render(scene, params);
  int all = 0, few = 0;
  for (std::size_t i = 0; i < borders.size(); ++i) {
    all += borders[i];
    few += borders[i] && found.counts[i] <= most;
  }
  return {all, few};
}

TEST(Adaptive, NoStraightBorderIsWithoutExtraSamples) {
  Random random{12};
  int borders = 0;
  for (int round = 0; round < 20; ++round) {
    // A black half plane before a black background. Only its border requires more samples.
    Scene scene;
    scene.view.from = {0, 0, 8};
    scene.surfaces.push_back({.colour = {}, .kd = 0});
    const double angle = random.range(0, 2 * std::numbers::pi);
    const Vec along{std::cos(angle), std::sin(angle), 0}, across{-along.y, along.x, 0};
    const Vec at = random.range(-2, 2) * across;
    const double far = 1000;
    add_polygon(
        scene, std::vector<Vec>{at - far * along, at + far * along, at + far * along + far * across,
                                at - far * along + far * across});
    finish(scene);
    const auto [all, few] = count_borders(scene, make_adaptive(32, 1), 16);
    borders += all;
    EXPECT_EQ(few, 0) << "of " << all;
  }
  EXPECT_GT(borders, 500);
}

// Adaptive sampling may miss balls that are smaller than a pixel, and balls that reach into a pixel
// only between its corners and samples.
TEST(Adaptive, HardlyABallsBorderIsWithoutExtraSamples) {
  for (const int spheres : {200, 3200}) {
    const Params params = make_adaptive(32, 0.01);
    const Scene scene = make_spheres(spheres);
    const auto [all, few] = count_borders(scene, params, 16);
    EXPECT_LT(few, 0.02 * all);
  }
}

TEST(Adaptive, AnyThreadsAndBlocksTheSameBits) {
  const Scene scene = make_random_scene(3, 30);
  const Params params = make_adaptive(24, 0.02, 64);
  const Rendering one = render(scene, params), three = render(scene, params, 3);
  EXPECT_EQ(one.samples, three.samples);
  EXPECT_EQ(one.counts, three.counts);
  EXPECT_EQ(one.rays, three.rays);
  Samples pieces(24, 24);
  Work work;
  for (const Area& area : {Area{0, 0, 7, 24}, Area{7, 0, 17, 11}, Area{7, 11, 17, 13}})
    add_block(pieces, render_block(scene, params, area), work);
  EXPECT_EQ(pieces, one.samples);
}

}  // namespace
}  // namespace renderer::test
