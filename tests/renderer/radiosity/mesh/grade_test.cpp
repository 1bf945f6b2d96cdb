// Patches near lights.

#include "renderer/radiosity/mesh/grade.hpp"

#include <gtest/gtest.h>

#include "renderer/radiosity/creases/creases.hpp"
#include "renderer/radiosity/mesh/divide.hpp"
#include "renderer/radiosity/show/reconstruct.hpp"
#include "tests/renderer/radiosity/blocks.hpp"
#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

bool is_light(const Room& room, const Face& face) {
  return max_component(room.materials[face.material].emission) > 0;
}

// Of many points of a light, the nearest.
double find_distance(const Face& light, const Vec& point) {
  constexpr int STEPS = 40;
  double least = INFINITY;
  for (int i = 0; i <= STEPS; ++i)
    for (int j = 0; j <= STEPS; ++j) {
      const Vec at = eval_bilinear(light.corners, double(i) / STEPS, double(j) / STEPS);
      least = std::min(least, length(at - point));
    }
  return least;
}

// The lines are those of the even grid, halved up to three times, and no others.
void check_halved(const std::vector<double>& lines, int even) {
  for (int i = 0; i <= even; ++i)
    EXPECT_TRUE(std::ranges::any_of(
        lines, [&](double line) { return std::abs(line - double(i) / even) < 1e-12; }));
  for (const double line : lines)
    EXPECT_NEAR(line * even * 8, std::round(line * even * 8), 1e-9) << "halved more than thrice";
  EXPECT_TRUE(std::ranges::is_sorted(lines));
}

TEST(Grade, NoPatchIsLongerThanHalfItsDistanceFromALight) {
  std::size_t halved = 0, near = 0, checked = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const int refine = 1 + static_cast<int>(seed % 3);
    Room room = make_blocks(seed).room;
    room.fine_near_lights = true;
    grade_near_lights(room, refine);
    EXPECT_FALSE(room.fine_near_lights);
    for (const Face& face : room.faces) {
      if (face.grid.along.empty()) continue;
      ASSERT_FALSE(is_light(room, face));
      ++halved;
      const auto& [along, across] = face.grid;
      check_halved(along, face.along * refine);
      check_halved(across, face.across * refine);
      const Plane plane = make_plane(normalize(eval_area_normal(face.corners)), face.corners[0]);
      for (std::size_t j = 0; j + 1 < across.size(); ++j)
        for (std::size_t i = 0; i + 1 < along.size(); ++i) {
          const Vec middle = eval_bilinear(face.corners, (along[i] + along[i + 1]) / 2,
                                           (across[j] + across[j + 1]) / 2);
          const auto thrice = [](double step, int even) { return step * even < 1.01 / 8; };
          const double wide = along[i + 1] - along[i], high = across[j + 1] - across[j];
          for (const Face& light : room.faces) {
            if (!is_light(room, light)) continue;
            const Plane front =
                make_plane(normalize(eval_area_normal(light.corners)), light.corners[0]);
            if (eval_height(front, middle) <= 0 || eval_height(plane, light.corners[0]) <= 0)
              continue;
            const double most = 0.5 * find_distance(light, middle) * 1.02;
            const double u = wide * length(face.corners[1] - face.corners[0]);
            const double v = high * length(face.corners[3] - face.corners[0]);
            EXPECT_TRUE(u <= most || thrice(wide, face.along * refine)) << u << ' ' << most;
            EXPECT_TRUE(v <= most || thrice(high, face.across * refine)) << v << ' ' << most;
            ++checked;
            near += std::min(u, v) > 0.5 * most;
          }
        }
    }
  }
  std::printf("%zu faces, %zu of %zu patches near what is allowed\n", halved, near, checked);
  EXPECT_GT(halved, 20u);
}

// A box with a lamp under its ceiling, near a wall.
Room make_lamp_room(double away) {
  Room room;
  room.materials = {{"wall", grey(0.5), {}}, {"lamp", grey(0), grey(1)}};
  add_box(room, 0, {0, 0, 0}, {3, 3, 2.5}, 8);
  add_quad(room, 1, {away, 1, 2.45}, {0, 0.5, 0}, {0.4, 0, 0});
  return room;
}

// The error of the lamp's light in the middles of the patches of the wall beside it, root mean
// square over the light's.
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
    EXPECT_LT(fine, coarse / 3);
  }
}

TEST(Grade, LeavesRoomsAloneThatDoNotAskForIt) {
  Room room = make_lamp_room(0.3);
  grade_near_lights(room, 1);
  for (const Face& face : room.faces) EXPECT_TRUE(face.grid.along.empty());
  // Behind a light it is dark.
  room.fine_near_lights = true;
  grade_near_lights(room, 1);
  EXPECT_TRUE(room.faces[1].grid.along.empty()) << "the ceiling";
  EXPECT_FALSE(room.faces[2].grid.along.empty()) << "the wall beside the lamp";
}

}  // namespace
}  // namespace radiosity::test
