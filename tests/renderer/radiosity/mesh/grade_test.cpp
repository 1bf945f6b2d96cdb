// Tests the refinement of patches near lights.

#include "renderer/radiosity/mesh/grade.hpp"

#include <gtest/gtest.h>

#include "renderer/radiosity/creases/creases.hpp"
#include "renderer/radiosity/mesh/divide.hpp"
#include "renderer/radiosity/show/reconstruct.hpp"
#include "tests/renderer/radiosity/blocks.hpp"
#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

// A box with a lamp under its ceiling. The lamp shines down. Its distance from the wall at low x is
// `away`.
Room make_lamp_room(double away) {
  Room room;
  room.materials = {{"wall", grey(0.5), {}}, {"lamp", grey(0), grey(1)}};
  add_box(room, 0, {0, 0, 0}, {3, 3, 2.5}, 8);
  add_quad(room, 1, {away, 1, 2.45}, {0, 0.5, 0}, {0.4, 0, 0});
  return room;
}

// The number of steps of length 1/even, of half this length, and of a quarter of it. Other lengths
// are errors.
std::array<std::size_t, 3> count_steps(const std::vector<double>& lines, int even) {
  std::array<std::size_t, 3> count{};
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const double halvings = -std::log2((lines[i] - lines[i - 1]) * even);
    EXPECT_NEAR(halvings, std::round(halvings), 1e-9);
    const auto h = static_cast<std::size_t>(std::lround(halvings));
    EXPECT_LT(h, 3u);
    if (h < 3) ++count[h];
  }
  return count;
}

// The root mean square error of the lamp's light at the centres of patches on the nearby wall,
// divided by the root mean square of the light.
double find_error(const Room& room) {
  const Mesh mesh = make_mesh(room, {});
  const auto find_light = [&](const Vertex& vertex) {
    return sum_factors({mesh, {}}, vertex, [](const Patch& patch) { return patch.material == 1; });
  };
  std::vector<Rgb> lit;
  for (const Vertex& vertex : mesh.vertices)
    lit.push_back(grey(vertex.material == 0 ? find_light(vertex) : 0));
  const Illumination shown = reconstruct(mesh, lit, {Reconstruction::bicubic, {}});
  double errors = 0, squares = 0;
  for (std::uint32_t p = 0; p < mesh.patches.size(); ++p) {
    const Patch& patch = mesh.patches[p];
    if (patch.face != 2) continue;
    Vertex middle = mesh.vertices[patch.corners[0]];
    middle.at = middle.lit = patch.centre;
    const double light = find_light(middle);
    const double off = eval_illumination(shown, p, 0.5, 0.5).r - light;
    errors += patch.area * off * off;
    squares += patch.area * light * light;
  }
  return std::sqrt(errors / squares);
}

TEST(Grade, ShowsTheLightOfALampBesideAWall) {
  for (const double away : {0.15, 0.3}) {
    SCOPED_TRACE(testing::Message() << "away " << away);
    Room room = make_lamp_room(away);
    choose_creases(room, Creases::found);
    const double fine = find_error(room);
    room.fine_near_lights = false;
    const double coarse = find_error(room);
    std::printf("%.2f from the wall: %.2f %%, without finer patches %.2f %%\n", away, 100 * fine,
                100 * coarse);
    EXPECT_LT(fine, 0.04);
    EXPECT_LT(fine, coarse / 4);
  }
}

// Rows must be halved where the light varies, and only there.
TEST(Grade, HalvesRowsBesideTheLamp) {
  const Room room = make_lamp_room(0.3);
  const Room graded = make_graded(room, 1);
  EXPECT_TRUE(graded.faces[1].grid.along.empty()) << "behind the lamp it is dark";
  EXPECT_TRUE(graded.faces[6].grid.along.empty()) << "the lamp";
  EXPECT_TRUE(graded.faces[3].grid.along.empty()) << "the wall that is far";
  // the first direction of this wall's grid is y, the second one z
  const Grid& wall = graded.faces[2].grid;
  ASSERT_FALSE(wall.along.empty());
  EXPECT_GT(count_steps(wall.along, 8)[1], 1u);
  EXPECT_GT(count_steps(wall.across, 8)[2], 1u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR(wall.across[i], 0.125 * double(i), 1e-12) << "the lower half is as it was";
  EXPECT_LE(wall.across.back() - wall.across[wall.across.size() - 2], 0.0626);
  EXPECT_LE(count_patches(graded, 1), 2 * count_patches(room, 1));
}

// Rows must not be halved again if the room would then have more than twice as many patches.
TEST(Grade, KeepsWithinTwiceAsManyPatches) {
  Room room = make_lamp_room(0.3);
  for (Face& face : room.faces) face.along = face.across = 1;
  add_quad(room, 1, {2.3, 1, 2.45}, {0, 0.5, 0}, {0.4, 0, 0});
  const Room graded = make_graded(room, 1);
  EXPECT_LE(count_patches(graded, 1), 2 * count_patches(room, 1));
  std::size_t halved = 0;
  for (const Face& face : graded.faces) {
    if (face.grid.along.empty()) continue;
    const auto across = count_steps(face.grid.across, 1);
    halved += across[1];
    EXPECT_EQ(across[2], 0u);
  }
  EXPECT_GT(halved, 2u);
}

// In rooms of any shape and position, steps are halved at most twice, and the number of patches at
// most doubles. A rotated room must have the same grids.
TEST(Grade, IsTheSameHoweverTheRoomIsTurned) {
  std::size_t halved = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Room room = make_blocks(seed).room;
    if (seed % 2 == 0) {  // one light in a wall, and one with two corners on the floor
      room.materials.push_back({"glow", grey(0.5), grey(2)});
      const auto glow = static_cast<std::uint32_t>(room.materials.size() - 1);
      const Vec low = room.faces[0].corners[0], along = room.faces[0].corners[1] - low;
      add_quad(room, glow, low, {0, 1, 0}, {0, 0, 1}, 2, 2).two_sided = seed % 4 == 0;
      add_quad(room, glow, low + 0.5 * (room.faces[0].corners[3] - low), along, {0, 0, 1}, 2, 2)
          .two_sided = seed % 4 == 0;
    }
    const Room graded = make_graded(room, 1);
    EXPECT_LE(count_patches(graded, 1), 2 * count_patches(room, 1));
    Room turned = room;
    const double angle = random.range(0, 7);
    const Vec shift{random.range(-9, 9), random.range(-9, 9), random.range(-9, 9)};
    for (Face& face : turned.faces)
      for (Vec& p : face.corners)
        p = shift + Vec{std::cos(angle) * p.x - std::sin(angle) * p.y,
                        std::sin(angle) * p.x + std::cos(angle) * p.y, p.z};
    turned = make_graded(turned, 1);
    for (std::size_t f = 0; f < room.faces.size(); ++f) {
      const Face& face = graded.faces[f];
      EXPECT_EQ(face.grid.along, turned.faces[f].grid.along) << f;
      EXPECT_EQ(face.grid.across, turned.faces[f].grid.across) << f;
      if (face.grid.along.empty()) continue;
      ++halved;
      count_steps(face.grid.along, face.along);
      count_steps(face.grid.across, face.across);
    }
  }
  std::printf("%zu faces with halved rows\n", halved);
  EXPECT_GT(halved, 20u);
}

TEST(Grade, ARoomWithoutLightStaysAsItIs) {
  Room room = make_lamp_room(0.3);
  room.materials[1].emission = grey(0);
  for (const Face& face : make_graded(room, 1).faces) EXPECT_TRUE(face.grid.along.empty());
}

}  // namespace
}  // namespace radiosity::test
