// Tests faces that are divided along any creases. The quads must fill the face and meet edge to
// edge, and the creases must be among their edges.

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/mesh/divisions.hpp"

namespace radiosity::test {
namespace {

using renderer::test::Random;

constexpr double TOUCH = 0.1;  // largest shift of a crease, as a fraction of a patch's width

struct Flat {
  Face face;
  Vec u, v;  // orthogonal unit vectors in the plane of the face
  double width = 0;
  Vec at(double x, double y) const { return x * u + y * v; }
};

// A convex polygon whose corners lie on an ellipse.
Flat make_polygon(Random& random, int corners) {
  const auto [u, v] = renderer::test::make_plane(random.direction());
  Flat flat{{}, u, v, 0};
  const double flatness = random.range(0.5, 1), turn = random.unit();
  double shortest = 1e9;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + turn + random.range(0, 0.5)) / corners;
    flat.face.corners.push_back(flat.at(2 * std::cos(angle), 2 * flatness * std::sin(angle)));
  }
  flat.face.along = 1 + random.below(4);
  flat.face.across = corners == 4 ? 1 + random.below(4) : flat.face.along;
  for (std::size_t i = 0; i < flat.face.corners.size(); ++i) {
    const double edge =
        length(flat.face.corners[(i + 1) % flat.face.corners.size()] - flat.face.corners[i]);
    const int steps = corners != 4 ? 2 * flat.face.along
                      : i % 2 == 0 ? flat.face.along
                                   : flat.face.across;
    shortest = std::min(shortest, edge / steps);
  }
  flat.width = shortest;
  return flat;
}

Flat make_rectangle(Random& random) {
  Flat flat = make_polygon(random, 4);
  const double x = random.range(0.5, 2), y = random.range(0.5, 2);
  flat.face.corners = {flat.at(-x, -y), flat.at(x, -y), flat.at(x, y), flat.at(-x, y)};
  flat.width = std::min(2 * x / flat.face.along, 2 * y / flat.face.across);
  return flat;
}

std::vector<Crease> make_creases(Random& random, const Flat& flat, int count) {
  std::vector<Crease> creases;
  for (int i = 0; i < count; ++i) {
    const auto number = [&] { return random.range(-2, 2); };
    const double ax = number(), ay = number(), bx = number(), by = number();
    creases.push_back({flat.at(ax, ay), flat.at(bx, by)});
  }
  return creases;
}

// Expects that those points of the creases that are inside the face lie on listed edges, and that
// listed edges lie on creases.
void check_creases(const Flat& flat, const Division& division, std::span<const Crease> creases) {
  const Vec normal = normalize(eval_area_normal(flat.face.corners));
  const auto& c = flat.face.corners;
  const double touch = TOUCH * flat.width;
  const auto is_inside = [&](const Vec& p) {
    for (std::size_t i = 0; i < c.size(); ++i) {
      const Vec edge = normalize(c[(i + 1) % c.size()] - c[i]);
      if (dot(normal, cross(edge, p - c[i])) < 2 * touch) return false;
    }
    return true;
  };
  for (const Crease& crease : creases)
    for (int i = 1; i < 50 && length(crease.b - crease.a) > 2 * touch; ++i) {
      const Vec p = crease.a + i / 50.0 * (crease.b - crease.a);
      if (!is_inside(p)) continue;
      double nearest = 1e9;
      for (const auto& [a, b] : division.creases)
        nearest = std::min(nearest, eval_distance(p, division.points[a], division.points[b]));
      // Near its end, a crease may cut the corner of a cell, over a length of at most `touch`.
      ASSERT_LE(nearest, 1.5 * touch) << "crease not covered";
    }
  for (const auto& [a, b] : division.creases)
    for (const auto point : {a, b}) {
      double nearest = 1e9;
      for (const Crease& crease : creases)
        nearest = std::min(nearest, eval_distance(division.points[point], crease.a, crease.b));
      ASSERT_LE(nearest, 1.5 * touch) << "edge not on a crease";
    }
}

TEST(DivideCreases, AnyFaceAndCreases) {
  std::vector<double> angles;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Flat flat =
        seed % 2 == 0 ? make_rectangle(random) : make_polygon(random, 3 + random.below(4));
    auto creases = make_creases(random, flat, 1 + random.below(6));
    for (std::size_t i = 1; i < creases.size() && seed % 4 == 0; i += 2) {
      const auto& c = flat.face.corners;
      const double s = random.unit();
      // a crease along one side of the face
      creases[i] = {eval_bilinear(c, s, random.unit()), eval_bilinear(c, s, 1)};
    }
    const Division division = divide_face(flat.face, 1, {.creases = creases});
    angles.push_back(check_division(flat.face, 1, division));
    check_creases(flat, division, creases);
    EXPECT_EQ(division.left_out, 0u);
    if (testing::Test::HasFailure()) return;
  }
  // Creases may meet at any angle, and therefore the edges of quads may too. Only very few angles
  // may be small.
  std::sort(angles.begin(), angles.end());
  EXPECT_GT(angles.front(), 0.3);
  EXPECT_GT(angles[angles.size() / 20], 1.5);
  EXPECT_GT(angles[angles.size() / 2], 10);
}

// The length of the step between grid lines that contains the position `middle`.
double find_step(const std::vector<double>& lines, double middle) {
  const auto after = std::ranges::upper_bound(lines, middle);
  return *after - *std::prev(after);
}

// Rows that have been halved must stay narrow if creases run across them.
TEST(DivideCreases, NarrowRowsStayNarrow) {
  double widest = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Flat flat = make_rectangle(random);
    auto& grid = flat.face.grid = find_grid(flat.face, 1);
    for (auto* lines : {&grid.along, &grid.across})
      for (int halvings = 0; halvings < 2; ++halvings) {
        std::vector<bool> marks;
        for (std::size_t i = 0; i < lines->size(); ++i) marks.push_back(random.below(3) == 0);
        halve(*lines, marks);
      }
    flat.width = find_patch_width(flat.face, 1);
    const auto creases = make_creases(random, flat, 1 + random.below(4));
    const Division division = divide_face(flat.face, 1, {.creases = creases});
    check_division(flat.face, 1, division);
    check_creases(flat, division, creases);
    const auto& c = flat.face.corners;
    const auto find_share = [&](const Vec& p, const Vec& side) {
      return dot(p - c[0], side) / dot(side, side);
    };
    for (const auto& quad : division.quads)
      for (const auto& [lines, side] :
           {std::pair{&grid.along, c[1] - c[0]}, {&grid.across, c[3] - c[0]}}) {
        double low = 1, high = 0;
        for (const auto corner : quad) {
          const double share = find_share(division.points[corner], side);
          low = std::min(low, share);
          high = std::max(high, share);
        }
        widest = std::max(widest, (high - low) / find_step(*lines, (low + high) / 2));
      }
    if (testing::Test::HasFailure()) return;
  }
  std::printf("patches are at most %.2f times as wide as their rows\n", widest);
  EXPECT_LT(widest, 2);
}

TEST(DivideCreases, Hundreds) {
  Random random{77};
  const Flat flat = make_rectangle(random);
  const auto creases = make_creases(random, flat, 300);
  const Division division = divide_face(flat.face, 2, {.creases = creases});
  check_division(flat.face, 1, division);
  EXPECT_LT(division.quads.size(), 30'000u);
}

// A rectangle of 4 x 3 units, divided into 4 x 3 patches.
Face make_wall() {
  Face face;
  face.corners = {{0, 0, 0}, {4, 0, 0}, {4, 3, 0}, {0, 3, 0}};
  face.along = 4;
  face.across = 3;
  return face;
}

TEST(DivideCreases, AlongTheSidesItStaysAGrid) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Flat flat = make_rectangle(random);
    const auto& c = flat.face.corners;
    std::vector<Crease> creases;
    const auto at = [&](double s, double t) { return eval_bilinear(c, s, t); };
    for (int i = random.below(6); i >= 0; --i) {
      const double s = random.unit(), t = random.unit(), other = random.unit();
      creases.push_back(i % 2 == 0 ? Crease{at(s, t), at(s, other)}
                                   : Crease{at(s, t), at(other, t)});
    }
    const Division division = divide_face(flat.face, 1, {.creases = creases});
    EXPECT_NEAR(check_division(flat.face, 1, division), 90, 1e-6);
    check_creases(flat, division, creases);
    const auto count = static_cast<std::size_t>(creases.size());
    EXPECT_LE(division.quads.size(),
              (flat.face.along + 2 * count) * (flat.face.across + 2 * count));
  }
}

TEST(DivideCreases, LinesOfTheGridGiveWay) {
  // A grid line moves to a crease that is nearer than a third of a patch, and stays otherwise.
  for (const auto& [x, columns] :
       {std::pair{2.0, 4u}, {2.3, 4u}, {1.7, 4u}, {2.4, 5u}, {3.95, 4u}}) {
    const std::vector<Crease> creases{{{x, 0, 0}, {x, 1.2, 0}}};
    const Division division = divide_face(make_wall(), 1, {.creases = creases});
    EXPECT_EQ(division.quads.size(), columns * 3) << x;
    EXPECT_EQ(division.creases.size(), 1u) << x;
  }
}

TEST(DivideCreases, ThoseElsewhereChangeNothing) {
  const Face wall = make_wall();
  const Division plain = divide_face(wall, 2);
  // a crease in front of the face
  const std::vector<Crease> elsewhere{{{1, 1, 0.01}, {2, 2, 0.01}},
                                      // A crease that passes through the face.
                                      {{1, 1, 0}, {2, 2, 1}},
                                      {{4.2, 0, 0}, {4.2, 3, 0}},     // a crease beside the face
                                      {{-1, 2.5, 0}, {0.4, 3.9, 0}},  // a crease past a corner
                                      {{1, 1, 0}, {1, 1, 0}}};        // a crease of length zero
  const Division division = divide_face(wall, 2, {.creases = elsewhere});
  EXPECT_EQ(division.points, plain.points);
  EXPECT_EQ(division.quads, plain.quads);
  EXPECT_TRUE(division.creases.empty());
  // A crease on the border of the face adds no quads, but is listed.
  const std::vector<Crease> border{{{0, 0, 0}, {4, 0, 0}}};
  EXPECT_EQ(divide_face(wall, 2, {.creases = border}).quads, plain.quads);
  EXPECT_EQ(divide_face(wall, 2, {.creases = border}).creases.size(), 8u);
}

}  // namespace
}  // namespace radiosity::test
