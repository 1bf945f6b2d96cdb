// Tests the positions of samples: one in every region, for any number of samples.

#include "renderer/trace/sampling.hpp"

#include <gtest/gtest.h>

#include <set>

#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

constexpr int MOST = 70;
constexpr Dimension DIMENSIONS[] = {Dimension::pixel, Dimension::lens,  Dimension::time,
                                    Dimension::light, Dimension::gloss, Dimension::translucency};

bool holds(const Region& r, const SquarePoint& p) {
  return p.u >= r.u && p.u < r.u + r.width && p.v >= r.v && p.v < r.v + r.height;
}

TEST(Sampling, PermuteIsAPermutation) {
  for (int count = 1; count <= MOST; ++count)
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      const auto key = static_cast<std::uint32_t>(Random{seed}.bits());
      std::set<int> found;
      for (int i = 0; i < count; ++i) found.insert(permute(i, count, key));
      ASSERT_EQ(found.size(), static_cast<std::size_t>(count)) << "key " << key;
      ASSERT_EQ(*found.begin(), 0) << "count " << count << " key " << key;
      ASSERT_EQ(*found.rbegin(), count - 1) << "count " << count << " key " << key;
    }
}

// Every element must be equally frequent at every place, within 5 standard deviations.
TEST(Sampling, PermuteIsNotPartialToAnyPlace) {
  for (const int count : {2, 3, 5, 8, 13}) {
    constexpr int TIMES = 20000;
    std::vector<int> at(static_cast<std::size_t>(count * count));
    Random random{static_cast<std::uint64_t>(count)};
    for (int n = 0; n < TIMES; ++n) {
      const auto key = static_cast<std::uint32_t>(random.bits());
      for (int i = 0; i < count; ++i)
        ++at[static_cast<std::size_t>(i * count + permute(i, count, key))];
    }
    const double mean = 1.0 * TIMES / count, deviation = std::sqrt(mean * (1 - 1.0 / count));
    for (const int often : at) EXPECT_NEAR(often, mean, 5 * deviation) << "count " << count;
  }
}

TEST(Sampling, RegionsAreEqualAndTileTheSquare) {
  for (int count = 1; count <= MOST; ++count) {
    std::vector<Region> regions;
    for (int i = 0; i < count; ++i) {
      regions.push_back(make_region(i, count));
      const Region& r = regions.back();
      ASSERT_NEAR(r.width * r.height * count, 1, 1e-12) << i << " of " << count;
      ASSERT_LE(std::max(r.width / r.height, r.height / r.width), 3.001) << i << " of " << count;
    }
    Random random{static_cast<std::uint64_t>(count)};
    for (int n = 0; n < 200; ++n) {
      const double u = random.unit(), v = random.unit();
      const auto in = std::ranges::count_if(regions, [&](const Region& r) {
        return holds(r, {u, v});
      });
      ASSERT_EQ(in, 1) << count << " regions, (" << u << ", " << v << ")";
    }
  }
}

// Expects that the samples of a pixel are distributed one per region, in the regions of a square
// and of a line.
void expect_one_in_each(const Sampling& sampling, SampleKey key, int count) {
  for (const Dimension dimension : DIMENSIONS) {
    std::vector<int> in_square(static_cast<std::size_t>(count)), in_line(in_square);
    for (key.pass = 0; key.pass < count; ++key.pass) {
      const SquarePoint p = sample_square(sampling, key, dimension);
      for (int i = 0; i < count; ++i)
        in_square[static_cast<std::size_t>(i)] += holds(make_region(i, count), p);
      const double t = sample_line(sampling, key, dimension);
      ASSERT_TRUE(t >= 0 && t < 1);
      ++in_line[static_cast<std::size_t>(t * count)];
    }
    ASSERT_EQ(in_square, std::vector<int>(static_cast<std::size_t>(count), 1));
    ASSERT_EQ(in_line, std::vector<int>(static_cast<std::size_t>(count), 1));
  }
}

TEST(Sampling, EveryRegionHasOneSample) {
  for (int count = 1; count <= MOST; ++count) {
    SCOPED_TRACE(testing::Message() << count << " samples");
    Random random{static_cast<std::uint64_t>(count)};
    const SampleKey key{static_cast<std::uint32_t>(random.bits()), 0,
                        static_cast<std::uint32_t>(random.bits())};
    Sampling sampling;
    sampling.pixel_samples = count;
    sampling.seed = random.bits();
    expect_one_in_each(sampling, key, count);
  }
}

// The regions of a sample in two dimensions, or in two pixels, must be independent: all pairs of
// regions are equally frequent, within 5 standard deviations.
TEST(Sampling, RegionsArePairedAtRandom) {
  constexpr int COUNT = 5, PIXELS = 20000;
  Sampling sampling;
  sampling.pixel_samples = COUNT;
  const auto region_of = [&](SampleKey key, Dimension dimension) {
    return static_cast<std::size_t>(sample_line(sampling, key, dimension) * COUNT);
  };
  std::vector<int> dimensions(COUNT * COUNT), pixels(dimensions), paths(dimensions);
  for (std::uint32_t pixel = 0; pixel < PIXELS; ++pixel) {
    const std::size_t time = region_of({pixel, 2}, Dimension::time) * COUNT;
    ++dimensions[time + region_of({pixel, 2}, Dimension::lens)];
    ++pixels[time + region_of({pixel + 1, 2}, Dimension::time)];
    ++paths[time + region_of({pixel, 2, 3}, Dimension::time)];
  }
  const double mean = 1.0 * PIXELS / dimensions.size();
  for (const auto* pairs : {&dimensions, &pixels, &paths})
    for (const int often : *pairs) EXPECT_NEAR(often, mean, 5 * std::sqrt(mean));
}

TEST(Sampling, TheDiscIsTheSquareInProportion) {
  constexpr int SIDE = 400;
  const double radii[] = {0.25, 0.5, 0.75, 0.9};
  int within[4] = {}, right = 0, above = 0;
  for (int i = 0; i < SIDE * SIDE; ++i) {
    const auto [u, v] = map_to_disc({(i % SIDE + 0.5) / SIDE, (i / SIDE + 0.5) / SIDE});
    const double radius = std::hypot(u, v);
    ASSERT_LE(radius, 1 + 1e-15);
    for (int r = 0; r < 4; ++r) within[r] += radius < radii[r];
    right += u > std::abs(v);
    above += v > std::abs(u);
  }
  for (int r = 0; r < 4; ++r)
    EXPECT_NEAR(within[r], SIDE * SIDE * radii[r] * radii[r], 0.005 * SIDE * SIDE);
  EXPECT_NEAR(right, SIDE * SIDE / 4, 2 * SIDE);
  EXPECT_NEAR(above, SIDE * SIDE / 4, 2 * SIDE);
}

TEST(Sampling, AcrossIsOrthonormal) {
  Random random{1};
  for (int i = 0; i < 1000; ++i) {
    const Vec axes[] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}};
    const Vec axis = i < 4 ? axes[i] : random.direction();
    const auto [u, v] = make_across(axis);
    EXPECT_NEAR(length(u), 1, 1e-12);
    EXPECT_NEAR(length(v), 1, 1e-12);
    EXPECT_NEAR(dot(u, v), 0, 1e-12);
    EXPECT_NEAR(dot(u, axis), 0, 1e-12);
    EXPECT_NEAR(dot(v, axis), 0, 1e-12);
  }
}

}  // namespace
}  // namespace renderer::test
