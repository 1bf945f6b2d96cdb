// Tests that adaptive meshes have small patches where the illumination varies.

#include "renderer/radiosity/show/adapt.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "renderer/radiosity/show/picture.hpp"
#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

constexpr ReconstructionParams BILINEAR{Reconstruction::bilinear};

// A floor of the given width, with a lamp of 2 x 2 at height 3 above its middle. The view from
// above shows the whole floor, or 40 x 40 of a larger one.
Room make_floor(double width) {
  Room room;
  room.materials = {{"floor", grey(0.5), {}}, {"lamp", grey(0), grey(10)}};
  add_quad(room, 0, {-width / 2, -width / 2, 0}, {width, 0, 0}, {0, width, 0});
  add_quad(room, 1, {-1, -1, 3}, {0, 2, 0}, {2, 0, 0});
  room.view.from = {0, 0, 1000};
  room.view.angle = 2 * std::atan(std::min(width, 40.0) / 2 / 1000) * 180 / std::numbers::pi;
  return room;
}

// Root mean square error of the interpolated surfaces at a grid of points around the origin,
// divided by the root mean square of the light there.
double find_error(const Mesh& mesh, double width) {
  const Solution solution = solve(mesh, {});
  const auto shown = reconstruct(mesh, solution.vertices, BILINEAR);
  const FactorParams fine{.spread = 0.05};
  const Eye eye{mesh, fine};
  double off = 0, all = 0;
  Work work;
  for (std::uint32_t p = 0; p < mesh.patches.size(); ++p) {
    const Patch& patch = mesh.patches[p];
    if (mesh.materials[patch.material].emission.r > 0 || length(patch.centre) > width / 2) continue;
    for (const double s : {0.25, 0.5, 0.75})
      for (const double t : {0.25, 0.5, 0.75}) {
        const Vec at = Quad(patch).eval(s, t);
        const Vertex vertex{at, at, patch.normal, patch.material, patch.object};
        double light = 0;
        for (const Patch& lamp : mesh.patches)
          light +=
              0.5 * mesh.materials[lamp.material].emission.r * eval_factor(eye, vertex, lamp, work);
        const double error = eval_illumination(shown, p, s, t).r - light;
        off += patch.area * error * error;
        all += patch.area * light * light;
      }
  }
  return std::sqrt(off / all);
}

TEST(Adapt, TheErrorIsWhatIsAskedFor) {
  for (const double width : {10.0, 1000.0, 70'000.0}) {
    std::size_t patches = 0;
    for (const double error : {0.1, 0.02}) {
      const AdaptedMesh adapted = adapt_mesh(make_floor(width), {}, BILINEAR, {error});
      EXPECT_LE(adapted.error, error);
      const double found = find_error(adapted.mesh, 40);
      fmt::print("{} m, asked {}: {} patches, {} rounds, error {:.4f}\n", width, error,
                 adapted.mesh.patches.size(), adapted.rounds, found);
      EXPECT_LT(found, 1.3 * error);
      EXPECT_GT(adapted.mesh.patches.size(), patches);
      patches = adapted.mesh.patches.size();
    }
    EXPECT_LT(patches, 10'000u);
  }
}

// Even with Room::fine_near_lights, adapt_mesh() begins with even rows. It halves them only where
// the solution requires it.
TEST(Adapt, BeginsWithEvenRows) {
  Room room = make_floor(10);
  for (Vec& corner : room.faces[1].corners) corner.z = 1;
  LightParams params;
  params.mesh.refine = 4;
  const Mesh even = make_mesh(room, params.mesh);
  room.fine_near_lights = true;
  ASSERT_GT(make_mesh(room, params.mesh).patches.size(), even.patches.size());
  const AdaptedMesh adapted = adapt_mesh(room, params, BILINEAR, {1});
  EXPECT_EQ(adapted.rounds, 0);
  EXPECT_EQ(adapted.mesh.patches.size(), even.patches.size());
}

// The patches of a face must meet at their corners, so that their areas add up to that of the face.
// Every edge must belong to two patches on opposite sides, or to one patch if it is on the border.
TEST(Adapt, PatchesOfAFaceMeetAtTheirCorners) {
  const Mesh mesh = adapt_mesh(make_floor(10), {}, BILINEAR, {0.05}).mesh;
  double area = 0;
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const Patch& patch : mesh.patches) {
    if (patch.face != 0) continue;
    area += patch.area;
    for (std::size_t i = 0; i < 4; ++i)
      ++edges[std::minmax(patch.corners[i], patch.corners[(i + 1) % 4])];
  }
  EXPECT_NEAR(area, 100, 1e-9);
  for (const auto& [edge, count] : edges) {
    const Vec &a = mesh.vertices[edge.first].at, &b = mesh.vertices[edge.second].at;
    const bool border = (std::abs(a.x) == 5 && a.x == b.x) || (std::abs(a.y) == 5 && a.y == b.y);
    EXPECT_EQ(count, border ? 1 : 2);
  }
}

// A block stands on the floor. For floors of any size, the mesh must have edges along the block's
// foot.
TEST(Adapt, FeetStayContacts) {
  for (const double width : {4.0, 400.0}) {
    Room room = make_floor(width);
    add_block(room, 0, {0.2, 0.3, 0}, {0.7, 0.8, 0.6});
    const AdaptedMesh adapted = adapt_mesh(room, {}, BILINEAR, {0.03});
    fmt::print("{} m: {} patches, {} vertices, {} rounds, error {:.4f}\n", width,
               adapted.mesh.patches.size(), adapted.mesh.vertices.size(), adapted.rounds,
               adapted.error);
    EXPECT_LE(adapted.error, 0.03);
    EXPECT_LT(adapted.mesh.vertices.size(), 1.3 * adapted.mesh.patches.size() + 100);
    for (const Patch& patch : adapted.mesh.patches) {
      if (patch.face != 0) continue;
      bool inside = false, outside = false;
      for (const Vec& at : patch.at) {
        const double x = std::abs(at.x - 0.45), y = std::abs(at.y - 0.55);
        inside |= std::max(x, y) < 0.24;
        outside |= std::max(x, y) > 0.26;
      }
      EXPECT_FALSE(inside && outside);
    }
  }
}

// If the picture does not show the floor, none of its patches is halved.
TEST(Adapt, OnlyWhatThePictureShowsCounts) {
  Room room = make_floor(10);
  const std::size_t seen = adapt_mesh(room, {}, BILINEAR, {0.02}).mesh.patches.size();
  room.view.at = {0, 0, 2000};
  const AdaptedMesh turned = adapt_mesh(room, {}, BILINEAR, {0.02});
  EXPECT_EQ(turned.rounds, 0);
  EXPECT_GT(seen, 20 * turned.mesh.patches.size());
}

// The view shows the floor in a mirror that reflects half of each colour. The weight of the floor
// in the mean square of the picture is therefore a quarter.
TEST(Adapt, SharesAreOfThePictureAndOfItsSquare) {
  Room room = make_floor(10);
  room.materials.push_back({"glass", grey(0.5), {}});
  room.materials.back().mirror = true;
  const PictureParams picture{.width = 50, .height = 50};
  double all = 0;
  const Mesh straight = make_mesh(room, {});
  for (const Rgb& share : find_shares(straight, room.view, picture)) all += share.r;
  // the lamp's back is black and hides 2 x 2 of the ceiling's 10 x 10 units
  EXPECT_NEAR(all, 0.96, 1e-12);
  add_quad(room, 2, {-5, -5, 900}, {0, 10, 0}, {10, 0, 0});  // a mirror that faces down
  room.view.from = {0, 0, 0.5};
  room.view.at = {0, 0, 1};
  room.view.angle = 0.1;
  all = 0;
  const Mesh mirrored = make_mesh(room, {});
  for (const Rgb& share : find_shares(mirrored, room.view, picture)) all += share.r;
  EXPECT_NEAR(all, 1, 1e-12);  // the view shows only the lamp, 2.5 above the eye
  room.view.from = {3, 0, 0.5};
  room.view.at = {3, 0, 1};
  all = 0;
  for (const Rgb& share : find_shares(mirrored, room.view, picture)) all += share.r;
  EXPECT_NEAR(all, 0.25, 1e-12);
}

TEST(Adapt, EndsWhereNothingButLampsIsLit) {
  Room room;
  room.materials = {{"lamp", grey(0.5), grey(1)}};
  add_box(room, 0, {0, 0, 0}, {3, 2, 1.5});
  EXPECT_EQ(adapt_mesh(room, {}, BILINEAR, {0.01}).rounds, 0);
}

// The room has a mirror, a crease, a triangle and a two-sided face.
TEST(Adapt, TakesAnyRoom) {
  for (const Reconstruction kind : {Reconstruction::bilinear, Reconstruction::bicubic}) {
    Room room = make_floor(6);
    room.materials.push_back({"glass", grey(0.9), {}});
    room.materials.back().mirror = true;
    add_quad(room, 2, {-3, 3, 0}, {6, 0, 0}, {0, 0, 2});
    add_quad(room, 0, {-3, -1, 0.5}, {1, 0, 0}, {0, 2, 0.5}).two_sided = true;
    add_quad(room, 0, {2, -1, 0.5}, {1, 0, 0}, {0, 2, 0}).corners.pop_back();
    room.creases.push_back({{-2.3, -3, 0}, {-1.6, 3, 0}});
    const std::size_t before = make_mesh(room, {}).patches.size();
    const AdaptedMesh adapted = adapt_mesh(room, {}, {kind}, {0.05});
    const Mesh& mesh = adapted.mesh;
    fmt::print("{} patches, {} rounds, error {:.4f}\n", mesh.patches.size(), adapted.rounds,
               adapted.error);
    EXPECT_LE(adapted.error, 0.05);
    EXPECT_GT(mesh.patches.size(), 2 * before);
    EXPECT_EQ(mesh.mirrors.size(), 1u);
    // The patches cover every visible side exactly once: the floor, the lamp, the leaning face on
    // both sides, and the triangle.
    EXPECT_NEAR(mesh.area, 36 + 4 + 2 * std::sqrt(4.25) + 1, 1e-9);
    // No patch of the floor may extend across the crease.
    for (const Patch& patch : mesh.patches) {
      if (patch.face != 0) continue;
      double least = 0, most = 0;
      for (const Vec& at : patch.at) {
        const double side = cross(Vec{0.7, 6, 0}, at - Vec{-2.3, -3, 0}).z / 6;
        least = std::min(least, side);
        most = std::max(most, side);
      }
      EXPECT_TRUE(least > -1e-6 || most < 1e-6) << least << ' ' << most;
    }
  }
}

TEST(Adapt, IsForMeansOfCornersAndCentres) {
  LightParams params;
  params.solve.mean = Mean::corners;
  EXPECT_THROW(adapt_mesh(make_floor(10), params, BILINEAR, {0.1}), base::BadInput);
}

}  // namespace
}  // namespace radiosity::test
