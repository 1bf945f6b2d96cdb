// Tests that bicubic surfaces stay near the illumination around them.

#include "renderer/radiosity/show/limit.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/mesh/grids.hpp"

namespace radiosity::grids {
namespace {

constexpr ReconstructionParams LIMITED{Reconstruction::bicubic, Twist::estimated};

// Random values for vertices: some bright, some dark.
std::vector<Rgb> make_contrasts(Random& random, std::size_t count) {
  std::vector<Rgb> values;
  for (std::size_t i = 0; i < count; ++i)
    values.push_back(random.below(3) == 0 ? 20 * random.colour() : 0.05 * random.colour());
  return values;
}

// The range of the values of all patches that share a corner with `patch`.
Limits find_range(const Mesh& mesh, std::span<const Rgb> values, const Patch& patch) {
  Limits range{values[patch.corners[0]], values[patch.corners[0]]};
  for (const Patch& other : mesh.patches) {
    if (std::ranges::find_first_of(patch.corners, other.corners) == patch.corners.end()) continue;
    for (const auto corner : other.corners)
      for (const auto colour : {&Rgb::r, &Rgb::g, &Rgb::b}) {
        range.least.*colour = std::min(range.least.*colour, values[corner].*colour);
        range.most.*colour = std::max(range.most.*colour, values[corner].*colour);
      }
  }
  return range;
}

// True if one of the three rules of limit_change() allows the change, within a tolerance.
bool is_kept(double change, double value, double whole, double there) {
  constexpr double TINY = 1e-9;
  const double bend = whole - change, other_bend = there - whole;
  const bool is_monotone =
      change * whole >= -TINY && std::abs(change) <= 3 * std::abs(whole) + TINY;
  const bool is_peak = bend * other_bend >= 0 && std::abs(bend) <= 2 * std::abs(other_bend) + TINY;
  const bool is_small = std::abs(change) <= 0.15 * std::min(value, value + whole) + TINY;
  return is_monotone || is_peak || is_small;
}

TEST(Limit, ChangesBecomeTheNearestThatIsKept) {
  constexpr Limits WIDE{{-1e9, -1e9, -1e9}, {1e9, 1e9, 1e9}};
  Random random{5};
  int limited = 0;
  for (int i = 0; i < 500; ++i) {
    const double value = random.range(0, 5), whole = random.range(-value, 5),
                 there = random.range(-10, 10), change = random.range(-20, 20);
    const double found =
        limit_change(WIDE, {value, 0, 0}, {change, 0, 0}, {whole, 0, 0}, {there, 0, 0}).r;
    EXPECT_TRUE(is_kept(found, value, whole, there)) << i;
    limited += found != change;
    for (int k = 0; k < 100; ++k) {
      const double other = random.range(-20, 20);
      if (is_kept(other, value, whole, there)) {
        EXPECT_GE(std::abs(other - change), std::abs(found - change) - 1e-6) << i;
      }
    }
  }
  EXPECT_GT(limited, 100);
}

TEST(Limit, SurfacesStayNearTheIlluminationAroundThem) {
  int beyond_without = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const auto u = make_lines(4, &random), v = make_lines(4, &random);
    const Mesh mesh = make_grid(u, v, make_plane(random), &random);
    const auto values = make_contrasts(random, mesh.vertices.size());
    const auto limited = reconstruct(mesh, values, LIMITED);
    const auto free = reconstruct(mesh, values, BICUBIC);
    for (std::uint32_t p = 0; p < mesh.patches.size(); ++p) {
      const auto [least, most] = find_range(mesh, values, mesh.patches[p]);
      for (int i = 0; i < 20; ++i) {
        const double s = random.unit(), t = random.unit();
        const auto is_near = [&](const Illumination& illumination) {
          const Rgb shown = eval_illumination(illumination, p, s, t);
          return std::ranges::all_of(std::array{&Rgb::r, &Rgb::g, &Rgb::b}, [&](auto colour) {
            const double beyond = 0.25 * (most.*colour - least.*colour) + 1e-12;
            return shown.*colour <= most.*colour + beyond &&
                   shown.*colour >= std::max(least.*colour - beyond, least.*colour / 2 - 1e-12);
          });
        };
        EXPECT_TRUE(is_near(limited));
        beyond_without += !is_near(free);
      }
    }
  }
  EXPECT_GT(beyond_without, 0);
}

// One side of a line of vertices is lit, and the other is in shadow. A surface that follows only
// the slopes would go below the shadow and above the light.
TEST(Limit, NothingSwingsBesideALeap) {
  double swung = 0;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const double dark = random.range(0.01, 0.5);
    const Mesh mesh = make_grid(make_lines(8, &random), make_lines(8), make_plane(random), &random);
    std::vector<Rgb> values;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
      values.push_back(grey(v % 9 < 4 ? dark : 1));
    const auto limited = reconstruct(mesh, values, LIMITED),
               free = reconstruct(mesh, values, BICUBIC);
    for (std::uint32_t p = 0; p < mesh.patches.size(); ++p)
      for (const double s : {0.1, 0.3, 0.5, 0.7, 0.9})
        for (const double t : {0.1, 0.5, 0.9}) {
          const double shown = eval_illumination(limited, p, s, t).r;
          EXPECT_GT(shown, dark * 0.97);
          EXPECT_LT(shown, 1.03);
          swung = std::max(swung, eval_illumination(free, p, s, t).r);
        }
  }
  EXPECT_GT(swung, 1.06);
}

TEST(Limit, LeavesSmoothSurfacesAlone) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Mesh mesh = make_grid(make_lines(10), make_lines(10), make_plane(random), &random);
    const Vec a = random.direction(), b = random.direction();
    const auto values = take(mesh, [&](const Vec& at) {
      return Rgb{2 + std::sin(dot(a, at)), 2 + std::cos(dot(b, at)), 50 + dot(a, at) * dot(b, at)};
    });
    const auto limited = reconstruct(mesh, values, LIMITED);
    const auto free = reconstruct(mesh, values, BICUBIC);
    double apart = 0;
    for (std::uint32_t p = 0; p < mesh.patches.size(); ++p)
      for (const double s : {0.2, 0.5, 0.8})
        for (const double t : {0.2, 0.5, 0.8})
          apart = std::max(apart, eval_distance(eval_illumination(limited, p, s, t),
                                                eval_illumination(free, p, s, t)));
    EXPECT_LT(apart, 3e-3);
  }
}

// If a vertex is two corners of a patch, the surface must have the vertex's value at both of them.
TEST(Limit, PatchesWithTheSameVertexTwiceAreWhollyLit) {
  for (std::size_t corner = 0; corner < 4; ++corner) {
    Mesh mesh;
    for (const Vec& at : {Vec{0, 0, 0}, Vec{1, 0, 0}, Vec{0, 1, 0}})
      mesh.vertices.push_back({at, at, {0, 0, 1}, 0, 0});
    std::array<std::uint32_t, 4> corners{0, 0, 1, 2};
    std::ranges::rotate(corners, corners.begin() + static_cast<std::ptrdiff_t>(corner));
    add_patch(mesh, corners);
    for (const Twist twist : {Twist::zero, Twist::diagonal, Twist::estimated}) {
      const auto lit =
          reconstruct(mesh, std::vector<Rgb>(3, grey(3)), {Reconstruction::bicubic, twist});
      for (const double s : {0.0, 0.3, 1.0})
        for (const double t : {0.0, 0.6, 1.0})
          EXPECT_NEAR(eval_illumination(lit, 0, s, t).r, 3, 1e-12);
    }
  }
}

}  // namespace
}  // namespace radiosity::grids
