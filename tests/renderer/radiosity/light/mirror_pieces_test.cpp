// Tests mirrors that are divided into equal pieces (thesis Eq 3.17 and 3.18), by comparison with
// the exact view in the mirror.

#include <gtest/gtest.h>

#include "renderer/radiosity/light/mirrors.hpp"
#include "tests/renderer/radiosity/light/closed_forms.hpp"
#include "tests/renderer/radiosity/light/unfold.hpp"

namespace radiosity::test {
namespace {

// Provides points in the middle of a cube. Their normals are random. They see the cube's patches
// via the mirror at high x.
class Pieces : public testing::Test {
 protected:
  static Mesh make(int n) {
    Room room = make_cube("xyYzZ", true, n);
    add_walls(room, "X", 1, 2);
    return make_mesh(room, {});
  }
  static std::vector<Vertex> make_points(int count) {
    Random random{11};
    std::vector<Vertex> points;
    while (static_cast<int>(points.size()) < count) {
      const Vec at{random.range(0.2, 1.6), random.range(0.2, 1.8), random.range(0.2, 1.8)};
      points.push_back(make_point(at, random.direction()));
    }
    return points;
  }
  static double eval(const Mesh& mesh, const Vertex& point, const Patch& patch,
                     const FactorParams& params) {
    Work work;
    return eval_mirrored_light({mesh, params}, point, {patch, Glow(grey(1))}, work).r;
  }
};

// A receiver sees a delta area via a mirror of varying size. While the mirror shows only a part of
// it, thesis Eq 3.16 must be satisfied with h = omega_S / omega, afterwards Eq 3.12.
TEST_F(Pieces, OneAloneFollowsEquations312And316) {
  constexpr double SIDE = 0.2, AREA = SIDE * SIDE;
  const Vec emitter{0.5, 1, 0}, image{3.5, 1, 0};
  const Vertex receiver = make_point({0, 0, 0}, normalize(Vec{1, 0.2, 0.1}));
  const double along = length(image), cos_e = 3.5 / along, cos_s = cos_e;
  const double cos_r = dot(receiver.normal, image) / along, to_mirror = along * 2 / 3.5;
  const double omega = AREA * cos_e / (along * along);
  double before = 0;
  for (const double size : {0.01, 0.03, 0.1, 0.11, 0.12, 0.3, 1.0}) {
    Room room;
    room.materials = {{"lamp", grey(0), grey(1)}, {"mirror", grey(1), {}, true}};
    add_quad(room, 0, emitter - Vec{0, SIDE / 2, SIDE / 2}, {0, SIDE, 0}, {0, 0, SIDE});
    const Vec middle{2, 4 / 7.0, 0};
    add_quad(room, 1, middle - Vec{0, size / 2, size / 2}, {0, 0, size}, {0, size, 0});
    const Mesh mesh = make_mesh(room, {});
    const double found = eval(mesh, receiver, mesh.patches[0],
                              {.halvings = 0, .reflections = 1, .mirror_pieces = 1});
    const double h = std::min(1.0, size * size * cos_s / (to_mirror * to_mirror) / omega);
    const double expected = AREA * cos_e * cos_r / (closed::PI * along * along + h * AREA) * h;
    EXPECT_NEAR(found, expected, 1e-12) << size;
    EXPECT_GE(found, before - 1e-15);
    before = found;
  }
}

// h is the fraction of a delta area that a piece of a mirror shows. It is at most 1 for any shape
// of the mirror and for any position of the delta area's image in the mirror. The light is then at
// most that of thesis Eq 3.12.
TEST_F(Pieces, NeverShowMoreThanThereIs) {
  Random random{3};
  int lit = 0;
  for (int k = 0; k < 500; ++k) {
    Room room;
    room.materials = {{"lamp", grey(0), grey(1)}, {"mirror", grey(1), {}, true}};
    add_quad(room, 0, {0.5, 0.9, -0.1}, {0, 0.2, 0}, {0, 0, 0.2});
    const double height = random.range(0.001, 2), width = random.range(0.001, 0.1);
    const Vec middle{2, 4 / 7.0 + random.range(-0.06, 0.06), random.range(-0.06, 0.06)};
    add_quad(room, 1, middle - Vec{0, width / 2, height / 2}, {0, 0, height}, {0, width, 0});
    Room large = room;
    large.faces[1].corners = {{2, -9, -9}, {2, -9, 9}, {2, 9, 9}, {2, 9, -9}};
    const Vertex receiver = make_point({0, 0, 0}, normalize(Vec{1, 0.2, 0.1}));
    const auto found = [&](const Room& of) {
      const Mesh mesh = make_mesh(of, {});
      return eval(mesh, receiver, mesh.patches[0],
                  {.halvings = 0, .reflections = 1, .mirror_pieces = 1});
    };
    EXPECT_LE(found(room), 1.001 * found(large)) << width << " x " << height;
    lit += found(room) > 0;
  }
  EXPECT_GT(lit, 100);
}

// One piece shows more than every delta area. The result must be that of thesis Eq 3.12 for the
// mirror image, except for the difference between the disc of Eq 3.8 and the delta area.
TEST_F(Pieces, OneLargeOneIsTheImage) {
  const Mesh mesh = make(2);
  int lit = 0;
  for (const Vertex& point : make_points(20))
    for (const Patch& patch : mesh.patches) {
      const double piece = eval(
          mesh, point, patch, {.samples = 8, .halvings = 0, .reflections = 1, .mirror_pieces = 1});
      const double whole =
          eval(mesh, point, patch, {.samples = 8, .halvings = 0, .reflections = 1});
      EXPECT_NEAR(piece, whole, 0.05 * whole);
      lit += whole > 0;
    }
  EXPECT_GT(lit, 100);
}

// If a piece shows more than every delta area, one piece and four pieces must give equal results.
TEST_F(Pieces, LargerThanDeltaAreasDoNotMatter) {
  const Mesh mesh = make(2);
  for (const Vertex& point : make_points(4))
    for (const Patch& patch : mesh.patches)
      EXPECT_EQ(eval(mesh, point, patch, {.samples = 8, .reflections = 1, .mirror_pieces = 2}),
                eval(mesh, point, patch, {.samples = 8, .reflections = 1, .mirror_pieces = 1}));
}

// With smaller pieces, the result must converge to the exact view in the mirror: for every patch,
// and in total.
TEST_F(Pieces, SmallOnesConverge) {
  const Mesh mesh = make(1);
  const auto points = make_points(10);
  double last = 1;
  for (const int pieces : {8, 16, 32, 64, 128}) {
    double error = 0, found = 0, expected = 0;
    for (const Vertex& point : points)
      for (const Patch& patch : mesh.patches) {
        const double exact = eval(mesh, point, patch, {.spread = 0.06, .reflections = 1});
        const double share = eval(mesh, point, patch, {.reflections = 1, .mirror_pieces = pieces});
        error += std::abs(share - exact);
        found += share;
        expected += exact;
        EXPECT_LT(share, 1.02);
      }
    fmt::print("{} x {} pieces: {:.4f} of all patches, by patch {:.4f}\n", pieces, pieces,
               found / expected, error / expected);
    EXPECT_LT(error / expected, last);
    last = error / expected;
    if (pieces >= 64) {
      EXPECT_NEAR(found, expected, 0.01 * expected);
    }
  }
  EXPECT_LT(last, 0.03);
}

// On a path via two mirrors, the piece with the smaller solid angle counts. Solid angles are
// measured from the vertex, along the whole path.
TEST_F(Pieces, OfTwoMirrorsConverge) {
  Room room = make_cube("xyzZ", false, 1);
  add_walls(room, "XY", 1, 2);
  const Mesh mesh = make_mesh(room, {});
  const auto points = make_points(10);
  for (const int pieces : {16, 64}) {
    double error = 0, found = 0, expected = 0;
    for (const Vertex& point : points)
      for (const Patch& patch : mesh.patches) {
        const auto twice = [&](FactorParams params) {
          params.reflections = 2;
          const double both = eval(mesh, point, patch, params);
          params.reflections = 1;
          return both - eval(mesh, point, patch, params);
        };
        const double exact = twice({.spread = 0.06}), share = twice({.mirror_pieces = pieces});
        error += std::abs(share - exact);
        found += share;
        expected += exact;
      }
    fmt::print("{} x {} pieces of two mirrors: {:.4f} of all patches, by patch {:.4f}\n", pieces,
               pieces, found / expected, error / expected);
    if (pieces == 64) {
      EXPECT_LT(error, 0.05 * expected);
      EXPECT_NEAR(found, expected, 0.02 * expected);
    }
  }
}

// In a solution, many patches light a vertex, so that their errors cancel.
TEST_F(Pieces, LightARoom) {
  const Mesh mesh = make(3);
  const Solution exact = solve(mesh, make_params(0.01));
  double last = 0.03;
  for (const int pieces : {4, 32}) {
    const Solution found = solve(mesh, make_params(0.01, {.mirror_pieces = pieces}));
    double error = 0, total = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      error += std::abs(found.vertices[v].g - exact.vertices[v].g);
      total += exact.vertices[v].g;
    }
    EXPECT_LT(error / total, last);
    last = error / total;
    fmt::print("{} x {} pieces: {:.4f}\n", pieces, pieces, error / total);
  }
}

}  // namespace
}  // namespace radiosity::test
