// The stores of the ray database, compared with a simple list.
#include "simulator/farm/rays/ray_stores.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <tuple>

#include "renderer/scene/generators.hpp"
#include "tests/simulator/farm/farm_support.hpp"

namespace farm {
namespace {

const Cells CELLS{.width = 32, .max_cell = 8};

renderer::Ray random_ray(std::mt19937_64& random) {
  auto any = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  renderer::Ray ray;
  ray.kind = static_cast<renderer::RayKind>(any(4));
  ray.influence = {any(5) / 4.0, any(5) / 4.0, any(5) / 4.0};
  ray.level = static_cast<std::uint16_t>(1 + any(4));
  ray.sample = static_cast<std::uint32_t>(any(32 * 32));
  ray.through = any(2) == 0;
  ray.is_urgent = any(4) == 0;
  ray.pass = static_cast<std::uint16_t>(any(2));
  return ray;
}

int cell_size(const renderer::Ray& ray) {
  const int x = static_cast<int>(ray.sample) % 32, y = static_cast<int>(ray.sample) / 32;
  int size = 8;
  while (x % size != 0 || y % size != 0) size /= 2;
  return size;
}

double largest_factor(const renderer::Ray& ray) {
  return std::max({ray.influence.r, ray.influence.g, ray.influence.b});
}

// The criteria of section 4.3.4 of the thesis, where lower values come first. Each criterion
// decides only if all criteria before it are equal.
std::tuple<int, double, int, int> keys_of(const renderer::Ray& ray) {
  return {ray.pass, -largest_factor(ray), ray.level, -cell_size(ray) * (ray.is_urgent ? 4 : 1)};
}

bool is_within(const renderer::Ray& ray, const Limits& limits) {
  const int x = static_cast<int>(ray.sample) % 32, y = static_cast<int>(ray.sample) / 32;
  const int size = cell_size(ray);
  const auto& area = limits.area;
  const bool is_observed = area.width == 0 || (x < area.x + area.width && x + size > area.x &&
                                               y < area.y + area.height && y + size > area.y);
  return ray.level <= (ray.through ? limits.depth_transmitted : limits.depth_reflected) &&
         largest_factor(ray) >= limits.min_influence && size >= limits.min_cell && is_observed;
}

// The expected behaviour of the stores: a list that is searched.
struct Oracle {
  std::vector<renderer::Ray> rays;
  Limits limits;

  // Order of the stores: 0 for shadow feelers, 1 for rays within the limits, 2 for rays beyond
  // them.
  int rank(const renderer::Ray& r) const {
    return r.kind == renderer::RayKind::shadow ? 0 : is_within(r, limits) ? 1 : 2;
  }
  // If the stores may return `taken` first, removes an equal ray from the list and returns true.
  bool take(const renderer::Ray& taken) {
    const auto same = std::ranges::find_if(rays, [&](const renderer::Ray& r) {
      return r.sample == taken.sample && r.kind == taken.kind && r.through == taken.through &&
             keys_of(r) == keys_of(taken);
    });
    if (same == rays.end()) return false;
    const int rank_taken = rank(*same);
    for (const auto& other : rays) {
      if (rank(other) < rank_taken) return false;
      if (rank_taken == 1 && rank(other) == 1 && keys_of(other) < keys_of(*same)) return false;
    }
    rays.erase(same);
    return true;
  }
};

TEST(RayStores, GiveEveryRayOnceByPriority) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    std::mt19937_64 random(seed);
    Oracle oracle{{}, random_limits(random)};
    RayStores stores(CELLS, oracle.limits);
    DatabaseWork work;
    for (int step = 0; step < 300; ++step) {
      const auto choice = random() % 16;
      if (choice == 0) {
        oracle.limits = random_limits(random);
        stores.set_limits(oracle.limits, work);
      } else if (choice < 9) {
        oracle.rays.push_back(random_ray(random));
        stores.add(oracle.rays.back(), work);
      } else {
        const bool any = random() % 2 == 0;
        const auto ray = stores.take(any, work);
        const bool some = std::ranges::any_of(
            oracle.rays, [&](const auto& r) { return any || oracle.rank(r) < 2; });
        ASSERT_EQ(ray.has_value(), some);
        if (ray) {
          ASSERT_TRUE(oracle.take(*ray));
        }
      }
      ASSERT_EQ(stores.size(), oracle.rays.size());
    }
  }
}

// The first samples of all pixels must come first, whatever their influence factors, levels and
// weights.
TEST(Priority, FirstSamplesOfPixelsComeFirst) {
  renderer::Ray first, second;
  first.influence = {0.001, 0, 0};
  first.level = 9;
  second.influence = {1, 1, 1};
  second.pass = 1;
  for (const Weights& weights : {Weights{}, Weights{1, 2, 3}}) {
    EXPECT_TRUE(goes_before(first, second, CELLS, weights));
    EXPECT_FALSE(goes_before(second, first, CELLS, weights));
  }
}

// The priority must be the sum of the largest influence factor, 1 / level, and log(cell size) /
// log(largest cell size), each multiplied by its weight. Two rays with nearly equal sums may come
// in either order.
TEST(Priority, IsTheWeightedSumOfItsKeys) {
  std::mt19937_64 random(1);
  for (int i = 0; i < 2000; ++i) {
    const auto weight = [&] { return static_cast<double>(random() % 4); };
    const Weights weights{weight(), weight(), weight()};
    const auto sum = [&](const renderer::Ray& r) {
      return weights.influence * largest_factor(r) + weights.level / r.level +
             weights.cell * std::log2(cell_size(r) * (r.is_urgent ? 4 : 1)) / std::log2(8);
    };
    const auto a = random_ray(random), b = random_ray(random);
    if (a.pass != b.pass || weights == Weights{} || std::abs(sum(a) - sum(b)) < 1e-9) continue;
    EXPECT_EQ(goes_before(a, b, CELLS, weights), sum(a) > sum(b)) << i;
  }
}

TEST(RayStores, CountTheirWork) {
  RayStores stores(CELLS, {});
  DatabaseWork work;
  renderer::Ray weak, strong;
  weak.influence = {0.5, 0.5, 0.5};
  strong.influence = {1, 1, 1};
  stores.add(weak, work);
  EXPECT_EQ(work.heap_step, 0u);
  stores.add(strong, work);  // the strong ray is exchanged with the weak one in the heap
  EXPECT_EQ(work.heap_step, 1u);
  EXPECT_EQ(work.record_stored, 2u);
  EXPECT_EQ(work.ray_classified, 2u);
  EXPECT_EQ(stores.take(false, work)->influence.r, 1);
  EXPECT_EQ(stores.peaks().heap, 2u);
}

// A heap of n rays has log2(n) levels; no operation may exchange more rays than the heap has
// levels.
TEST(RayStores, HeapStepsAreLogarithmic) {
  std::mt19937_64 random(7);
  RayStores stores(CELLS, {});
  for (std::size_t n = 1; n <= 1000; ++n) {
    DatabaseWork work;
    renderer::Ray ray = random_ray(random);
    ray.kind = renderer::RayKind::reflected;
    stores.add(ray, work);
    EXPECT_LE(std::size_t{1} << work.heap_step, n);
  }
}

TEST(Priority, CellsAreTheLargestSquaresWithThatCorner) {
  const Cells cells{.width = 100, .max_cell = 16};
  auto size_at = [&](std::uint32_t x, std::uint32_t y) { return cells.size_of(y * 100 + x); };
  EXPECT_EQ(size_at(0, 0), 16);
  EXPECT_EQ(size_at(32, 64), 16);
  EXPECT_EQ(size_at(8, 0), 8);
  EXPECT_EQ(size_at(8, 4), 4);
  EXPECT_EQ(size_at(3, 16), 1);
  EXPECT_EQ(size_at(6, 10), 2);
}

TEST(Priority, InitialRaysAreOnePerPixelLargestCellsFirstAndShuffled) {
  const auto scene = renderer::make_spheres(1);
  renderer::Params params;
  params.width = 24;
  params.height = 20;
  const Cells cells{.width = 24, .max_cell = 8};
  const auto rays = make_initial_rays(scene, params, cells, 1);
  const auto other = make_initial_rays(scene, params, cells, 2);
  std::vector<std::uint32_t> samples, other_samples;
  for (const auto& ray : rays) samples.push_back(ray.sample);
  for (const auto& ray : other) other_samples.push_back(ray.sample);
  EXPECT_TRUE(std::ranges::is_sorted(samples, std::greater<>(),
                                     [&](std::uint32_t s) { return cells.size_of(s); }));
  EXPECT_NE(samples, other_samples);
  std::ranges::sort(samples);
  ASSERT_EQ(samples.size(), 24u * 20u);
  for (std::uint32_t i = 0; i < samples.size(); ++i) EXPECT_EQ(samples[i], i);
}

}  // namespace
}  // namespace farm
