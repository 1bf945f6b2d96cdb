// Tests the illumination between vertices: functions that must be reproduced, smoothness and
// accuracy.

#include "renderer/radiosity/show/reconstruct.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/renderer/radiosity/mesh/grids.hpp"

namespace radiosity::grids {
namespace {

constexpr Twist TWISTS[] = {Twist::zero, Twist::diagonal, Twist::estimated};
// Compares with a literal evaluation of thesis Eq 3.1, matrix by matrix.
TEST(Hermite, IsTheProductOfEq31) {
  constexpr double M[4][4] = {{2, -2, 1, 1}, {-3, 3, -2, -1}, {0, 0, 1, 0}, {1, 0, 0, 0}};
  Random random{1};
  for (int n = 0; n < 50; ++n) {
    std::array<Rgb, 16> g;
    for (Rgb& number : g) number = random.colour();
    const double s = random.unit(), t = random.unit();
    const double S[] = {s * s * s, s * s, s, 1}, T[] = {t * t * t, t * t, t, 1};
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = 0; k < 4; ++k)
          for (std::size_t l = 0; l < 4; ++l)
            sum += S[i] * M[i][j] * g[4 * j + k].b * M[l][k] * T[l];
    EXPECT_NEAR(eval_hermite(g, s, t).b, sum, 1e-12);
  }
}

TEST(Reconstruct, KeepsTheVertices) {
  Random random{2};
  const auto lines = make_lines(4, &random);
  const Mesh mesh = make_grid(lines, lines, make_plane(random), &random);
  const auto values = make_colours(random, mesh.vertices.size());
  for (const Twist twist : TWISTS)
    for (const auto kind : {Reconstruction::bilinear, Reconstruction::bicubic}) {
      const Illumination b = reconstruct(mesh, values, {kind, twist});
      for (std::uint32_t p = 0; p < mesh.patches.size(); ++p) {
        const auto& c = mesh.patches[p].corners;
        EXPECT_EQ(eval_illumination(b, p, 0, 0), values[c[0]]);
        EXPECT_EQ(eval_illumination(b, p, 1, 0), values[c[1]]);
        EXPECT_EQ(eval_illumination(b, p, 1, 1), values[c[2]]);
        EXPECT_EQ(eval_illumination(b, p, 0, 1), values[c[3]]);
      }
    }
}

TEST(Reconstruct, FlatIsTheMeanOfTheCorners) {
  Random random{3};
  const Mesh mesh = make_grid({0, 1}, {0, 1}, make_plane(random));
  const std::vector<Rgb> values{{1, 0, 0}, {2, 0, 0}, {3, 8, 0}, {6, 0, 4}};
  const auto flat = reconstruct(mesh, values, {Reconstruction::flat, Twist::zero});
  EXPECT_EQ(eval_illumination(flat, 0, 0.1, 0.9), (Rgb{3, 2, 1}));
  EXPECT_EQ(eval_illumination(flat, 0, 1, 0), (Rgb{3, 2, 1}));
}

TEST(Reconstruct, ConstantAndLinearFunctionsAreExactOnUnevenQuads) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const auto plane = make_plane(random);
    const auto shaken = [&](double u, double v) {
      return plane(u + random.range(-0.06, 0.06), v + random.range(-0.06, 0.06));
    };
    const int nu = 1 + random.below(4), nv = 1 + random.below(4);
    const Mesh mesh = make_grid(make_lines(nu), make_lines(nv), shaken, &random);
    const Vec way = random.point(1);
    const auto linear = [&](const Vec& at) { return Rgb{dot(at, way) + 20, 7, 20 - at.x}; };
    EXPECT_LT(find_error(mesh, reconstruct(mesh, take(mesh, linear), BICUBIC), linear), 1e-11);
    EXPECT_LT(find_error(mesh, reconstruct(mesh, take(mesh, linear), BILINEAR), linear), 1e-11);
  }
}

TEST(Reconstruct, QuadraticFunctionsAreExactOnParallelLines) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const auto u = make_lines(2 + random.below(3), &random);
    const auto v = make_lines(2 + random.below(3), &random);
    const Mesh mesh = make_grid(u, v, make_plane(random), &random);
    const Vec a = random.point(1), b = random.point(1);
    const auto quadratic = [&](const Vec& at) {
      return Rgb{100 + dot(a, at) * dot(b, at), 100 + at.x * at.y, 100 - at.z * at.z};
    };
    const auto values = take(mesh, quadratic);
    EXPECT_LT(find_error(mesh, reconstruct(mesh, values, BICUBIC), quadratic), 1e-10);
    EXPECT_GT(find_error(mesh, reconstruct(mesh, values, BILINEAR), quadratic), 1e-3);
  }
}

// The largest differences of value and of slope between two patches, at random points of their
// common edges. All nu x nv patches of the grid must begin at the same corner.
struct Gaps {
  double value = 0, slope = 0;
};
Gaps find_gaps(const Mesh& mesh, const Illumination& b, std::uint32_t nu, Random& random) {
  Gaps gaps;
  const auto look = [&](std::uint32_t p, double s, double t, std::uint32_t q, double s2,
                        double t2) {
    gaps.value = std::max(
        gaps.value, eval_distance(eval_illumination(b, p, s, t), eval_illumination(b, q, s2, t2)));
    const Vec way = find_point(mesh, p, s > t, t >= s) - find_point(mesh, p, 0, 0);
    const Rgb here = differentiate_along(mesh, b, p, s, t, way);
    const Rgb there = differentiate_along(mesh, b, q, s2, t2, way);
    gaps.slope = std::max(gaps.slope, eval_distance(here, there));
  };
  for (std::uint32_t p = 0; p < mesh.patches.size(); ++p)
    for (int n = 0; n < 5; ++n) {
      const double at = random.unit();
      if ((p + 1) % nu) look(p, 1, at, p + 1, 0, at);
      if (p + nu < mesh.patches.size()) look(p, at, 1, p + nu, at, 0);
    }
  return gaps;
}

TEST(Reconstruct, IsC1AcrossInnerBorders) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Mesh mesh = make_grid(make_lines(5, &random), make_lines(4, &random), make_plane(random));
    const auto values = make_colours(random, mesh.vertices.size());
    for (const Twist twist : {Twist::zero, Twist::estimated}) {
      const auto gaps =
          find_gaps(mesh, reconstruct(mesh, values, make_unlimited(twist)), 5, random);
      EXPECT_LT(gaps.value, 1e-12);
      EXPECT_LT(gaps.slope, 1e-6);
    }
    const auto gaps = find_gaps(mesh, reconstruct(mesh, values, BILINEAR), 5, random);
    EXPECT_LT(gaps.value, 1e-12);
    EXPECT_GT(gaps.slope, 0.1);  // this jump of the slope causes Mach bands
  }
}

// The mixed derivatives of the thesis agree on both sides of an edge only if the steps are equal.
TEST(Reconstruct, WithDiagonalTwistsIsC1OnEvenGridsOnly) {
  Random random{4};
  const auto lines = make_lines(4), uneven = make_lines(4, &random);
  const ReconstructionParams params = make_unlimited(Twist::diagonal);
  const auto find = [&](const std::vector<double>& u) {
    const Mesh mesh = make_grid(u, lines, make_plane(random));
    const auto values = make_colours(random, mesh.vertices.size());
    return find_gaps(mesh, reconstruct(mesh, values, params), 4, random);
  };
  EXPECT_LT(find(lines).slope, 1e-6);
  EXPECT_GT(find(uneven).slope, 1e-3);
  EXPECT_LT(find(uneven).value, 1e-12);
}

// Two grids without common vertices meet in a line. Their values there are equal, but the slopes
// across the line differ.
TEST(Reconstruct, IsC0ButNotC1AcrossCreases) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const auto u = make_lines(3, &random), v = make_lines(4, &random);
    const auto plane = make_plane(random);
    const double slant = random.range(-0.5, 0.5);
    const auto beyond = [&](double a, double b) { return plane(1 + 2 * a, b + slant * a); };
    const Mesh left = make_grid(u, v, plane), right = make_grid(u, v, beyond);
    const auto b = make_colours(random, left.vertices.size());
    auto c = make_colours(random, right.vertices.size());
    for (std::size_t row = 0; row < v.size(); ++row) c[4 * row] = b[4 * row + 3];
    const auto l = reconstruct(left, b, BICUBIC), r = reconstruct(right, c, BICUBIC);
    double slope = 0;
    for (std::uint32_t row = 0; row < 4; ++row) {
      const double t = random.unit();
      const std::uint32_t p = 3 * row + 2, q = 3 * row;
      EXPECT_LT(eval_distance(eval_illumination(l, p, 1, t), eval_illumination(r, q, 0, t)), 1e-12);
      const Vec way = plane(1, 0).at - plane(0, 0).at;
      slope = std::max(slope, eval_distance(differentiate_along(left, l, p, 1, t, way),
                                            differentiate_along(right, r, q, 0, t, way)));
    }
    EXPECT_GT(slope, 0.01);
  }
}

// Creases may make two grid lines almost coincide. An error in the narrow strip between them must
// not affect the wide patches.
TEST(Reconstruct, SmallErrorsOnNarrowPatchesStaySmall) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const double narrow = random.range(0.001, 0.1);
    const std::vector<double> u{0, 0.4, 0.4 + narrow, 1};
    const Mesh mesh = make_grid(u, u, make_plane(random), &random);
    std::vector<Rgb> values;
    for (int v = 0; v < 16; ++v) values.push_back(grey(9 + random.range(-0.01, 0.01)));
    const auto nine = [](const Vec&) { return grey(9); };
    EXPECT_LT(find_error(mesh, reconstruct(mesh, values, BICUBIC), nine, {}, 9), 0.1);
  }
}

TEST(Reconstruct, IsLinearInTheIlluminationColourByColour) {
  Random random{5};
  const auto u = make_lines(3, &random);
  const Mesh mesh = make_grid(u, u, make_plane(random), &random);
  const auto a = make_colours(random, 16), b = make_colours(random, 16);
  std::vector<Rgb> sum, reds;
  for (std::size_t v = 0; v < 16; ++v) {
    sum.push_back(1000 * a[v] + 0.001 * b[v]);
    reds.push_back({a[v].r, 0, b[v].r});
  }
  for (const Twist twist : TWISTS) {
    const ReconstructionParams params = make_unlimited(twist);
    const auto of_a = reconstruct(mesh, a, params), of_b = reconstruct(mesh, b, params);
    const auto of_sum = reconstruct(mesh, sum, params), of_reds = reconstruct(mesh, reds, params);
    for (std::uint32_t p = 0; p < 9; ++p) {
      const double s = random.unit(), t = random.unit();
      const Rgb x = eval_illumination(of_a, p, s, t), y = eval_illumination(of_b, p, s, t);
      EXPECT_LT(eval_distance(eval_illumination(of_sum, p, s, t), 1000 * x + 0.001 * y), 1e-9);
      EXPECT_EQ(eval_illumination(of_reds, p, s, t), (Rgb{x.r, 0, y.r}));
    }
  }
}

TEST(Reconstruct, DoesNotDependOnTheUnitOfLength) {
  Random random{6};
  const auto u = make_lines(3, &random);
  const auto plane = make_plane(random);
  const auto larger = [&](double a, double b) {
    Vertex vertex = plane(a, b);
    vertex.at = 1024 * vertex.at;
    return vertex;
  };
  const auto values = make_colours(random, 16);
  const auto a = reconstruct(make_grid(u, u, plane), values, BICUBIC);
  const auto b = reconstruct(make_grid(u, u, larger), values, BICUBIC);
  for (std::uint32_t p = 0; p < 9; ++p)
    EXPECT_LT(eval_distance(eval_illumination(a, p, 0.3, 0.6), eval_illumination(b, p, 0.3, 0.6)),
              1e-11);
}

TEST(Reconstruct, IsNeverBelowZero) {
  Random random{7};
  const Mesh mesh = make_grid(make_lines(3), make_lines(1), make_plane(random));
  const std::vector<Rgb> values{grey(8), grey(0), grey(0), grey(8),
                                grey(8), grey(0), grey(0), grey(8)};
  const auto b = reconstruct(mesh, values, BICUBIC);
  for (int i = 1; i < 20; ++i) {
    const Rgb shown = eval_illumination(b, 1, i / 20.0, 0.5);
    EXPECT_GE(shown.r, 0);
    EXPECT_LT(shown.r, 1e-12);
  }
}

TEST(Reconstruct, RefusesIlluminationsOfAnotherMesh) {
  Random random{8};
  const Mesh mesh = make_grid({0, 1}, {0, 1}, make_plane(random));
  try {
    reconstruct(mesh, std::vector<Rgb>(5), BICUBIC);
    FAIL();
  } catch (const base::BadInput& e) {
    EXPECT_STREQ(e.what(), "found 5 illuminations, expected 4, one for each vertex");
  }
}

}  // namespace
}  // namespace radiosity::grids
