// Tests patches whose radiosity varies over their area.

#include <gtest/gtest.h>

#include <map>

#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

// A flat quad without right angles that faces down.
Face make_random_face(Random& random) {
  const auto shake = [&](double x, double y) {
    return Vec{x + random.range(-0.4, 0.4), y + random.range(-0.4, 0.4), 2};
  };
  Face face;
  face.corners = {shake(-1, -1), shake(-1, 1), shake(1, 1), shake(1, -1)};
  face.material = 0;
  return face;
}

// A quad without right angles above a floor. With `mirror`, there is a mirror beside them.
Mesh make_lamp_and_floor(Random& random, bool mirror) {
  Room room;
  room.materials = {{"lamp", grey(0.5), grey(1)}, {"mirror", {0.9, 0.8, 0.7}, {}, true}};
  room.faces.push_back(make_random_face(random));
  add_quad(room, 0, {-2, -2, 0}, {4, 0, 0}, {0, 4, 0}, 3, 3);
  if (mirror) add_quad(room, 1, {-2.1, -2, 0.1}, {0, 4, 0}, {0, 0, 2.5});
  return make_mesh(room, {});
}

std::array<Rgb, 4> make_colours(Random& random) {
  return {random.colour(), random.colour(), random.colour(), random.colour()};
}

// The light of a patch that is divided into n x n pieces, each with a constant radiosity.
Rgb add_pieces(const Eye& eye, const Vertex& vertex, const Patch& patch, const Glow& glow, int n) {
  const Quad quad(patch);
  Work work;
  Rgb total;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const auto at = [&](int right, int up) {
        return quad.eval(static_cast<double>(i + right) / n, static_cast<double>(j + up) / n);
      };
      Patch piece = patch;
      piece.at = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
      piece.centre = 0.25 * (piece.at[0] + piece.at[1] + piece.at[2] + piece.at[3]);
      total += eval_factors(eye, vertex, piece, work) * glow.eval((i + 0.5) / n, (j + 0.5) / n);
    }
  return total;
}

TEST(Glow, OfCornersIsTheirsThere) {
  Random random{1};
  const auto corners = make_colours(random);
  const Glow glow(corners);
  EXPECT_FALSE(glow.is_even());
  EXPECT_TRUE(Glow(corners[0]).is_even());
  for (const double Rgb::*c : {&Rgb::r, &Rgb::g, &Rgb::b}) {
    EXPECT_NEAR(glow.eval(0, 0).*c, corners[0].*c, 1e-15);
    EXPECT_NEAR(glow.eval(1, 0).*c, corners[1].*c, 1e-15);
    EXPECT_NEAR(glow.eval(1, 1).*c, corners[2].*c, 1e-15);
    EXPECT_NEAR(glow.eval(0, 1).*c, corners[3].*c, 1e-15);
  }
}

// The lit point may be near the patch or far from it, and may also see it via mirrors. If the
// radiosity is constant, the light is the form factor multiplied by the radiosity.
TEST(Glow, IsWhatManyEvenPiecesGive) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Mesh mesh = make_lamp_and_floor(random, seed % 2 == 0);
    const FactorParams factor{.reflections = 1};
    const Eye eye{mesh, factor};
    const Patch& lamp = mesh.patches[0];
    const Glow glow(make_colours(random));
    Work work;
    for (const double z : {0.0, 1.0, 1.9}) {
      const Vertex vertex = make_point({random.range(-1, 1), random.range(-1, 1), z}, {0, 0, 1});
      const Rgb found = eval_light(eye, vertex, {lamp, glow}, work);
      const Rgb pieces = add_pieces(eye, vertex, lamp, glow, 40);
      for (const double Rgb::*c : {&Rgb::r, &Rgb::g, &Rgb::b})
        EXPECT_NEAR(found.*c, pieces.*c, 0.004 * pieces.*c) << z;
      const Rgb even = eval_light(eye, vertex, {lamp, Glow(glow.at)}, work);
      const Rgb factors = eval_factors(eye, vertex, lamp, work);
      for (const double Rgb::*c : {&Rgb::r, &Rgb::g, &Rgb::b})
        EXPECT_NEAR(even.*c, factors.*c * (glow.at.*c), 1e-14);
    }
  }
}

// For any light at its corners and its centre, a patch sends exactly its power and no negative
// light.
TEST(Glow, OfAShotHasThePatchsPower) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Mesh mesh = make_lamp_and_floor(random, false);
    State state = make_state(mesh, Sends::corners);
    Work work;
    state.unshot[0] = random.colour();
    state.in_corners[0] = make_colours(random);
    if (seed % 5 == 0) state.in_corners[0] = {};
    const auto shot = find_shot(mesh, state, std::array{0u}, work);
    ASSERT_TRUE(shot);
    const Quad quad(mesh.patches[0]);
    for (const double Rgb::*c : {&Rgb::r, &Rgb::g, &Rgb::b}) {
      double power = 0;
      for (int i = 0; i < 3600; ++i) {
        const double s = (i % 60 + 0.5) / 60, t = (i / 60 + 0.5) / 60;
        power += quad.eval_density(s, t) * (shot->glow.eval(s, t).*c) / 3600;
      }
      const double expected = mesh.patches[0].area * state.unshot[0].*c;
      EXPECT_NEAR(power, expected, 1e-3 * expected);
      for (const double s : {0, 1})
        for (const double t : {0, 1}) EXPECT_GE(shot->glow.eval(s, t).*c, -1e-15);
    }
  }
}

// At the edge between wall and ceiling, each of them must receive the light that the other sends
// right at the edge, not the mean light of the other's patches.
TEST(Glow, OfCornersIsRightInTheRoomsEdges) {
  Room room;
  room.materials = {{"wall", grey(0.7), {}}, {"lamp", grey(0), grey(1)}};
  add_box(room, 0, {0, 0, 0}, {4, 3, 2.5});
  add_quad(room, 1, {1.5, 1, 2.4}, {0, 1, 0}, {1, 0, 0});
  const auto light = [&](int refine, Sends sends) {
    const Mesh mesh = make_mesh(room, {.refine = refine});
    SolveParams params = make_params(1e-3);
    params.sends = sends;
    const Solution solution = solve(mesh, params);
    std::map<std::array<double, 6>, double> found;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const auto& [at, lit, normal, material, object] = mesh.vertices[v];
      const bool in_edge =
          (at.x == 0 || at.x == 4) + (at.y == 0 || at.y == 3) + (at.z == 0 || at.z == 2.5) >= 2;
      if (in_edge) found[{at.x, at.y, at.z, normal.x, normal.y, normal.z}] = solution.vertices[v].g;
    }
    return found;
  };
  const auto fine = light(12, Sends::corners);
  const auto eval_error = [&](Sends sends) {
    double square = 0, mean = 0;
    const auto coarse = light(2, sends);
    for (const auto& [vertex, radiosity] : coarse) {
      const double exact = fine.at(vertex), off = radiosity / exact - 1;
      square += off * off / static_cast<double>(coarse.size());
      mean += off / static_cast<double>(coarse.size());
    }
    fmt::print("{} vertices in edges, {}: off by {:.4f}, {:.4f} in the mean\n", coarse.size(),
               sends == Sends::mean ? "mean" : "corners", std::sqrt(square), mean);
    return std::sqrt(square);
  };
  EXPECT_LT(eval_error(Sends::corners), 0.7 * eval_error(Sends::mean));
}

}  // namespace
}  // namespace radiosity::test
