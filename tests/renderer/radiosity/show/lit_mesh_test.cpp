// Tests fine patches and penumbrae near small, bright lights: make_lit_mesh() and
// Room::fine_shadows.

#include <gtest/gtest.h>

#include "renderer/radiosity/creases/creases.hpp"
#include "renderer/radiosity/show/adapt.hpp"
#include "tests/renderer/radiosity/rooms.hpp"

namespace radiosity::test {
namespace {

// A lamp hangs below a ceiling and near a wall. A narrow strip of the wall is bright and lights the
// border of the ceiling.
constexpr const char* LAMP_BESIDE_A_WALL = R"(
material wall reflect 0.7 0.7 0.7
material lamp reflect 0 0 0  emit 15 15 15
box wall  0 0 0  3 3 2.4  divide 5 inside
quad lamp  1 0.1 2.3  1 0.6 2.3  1.6 0.6 2.3  1.6 0.1 2.3
view from 1.5 2.9 1.2 at 1.5 0 1.2 up 0 0 1 angle 70 size 40 30
)";

// A wall with a slit of 8 cm separates a lamp from the other half of the room.
constexpr const char* SLIT = R"(
material wall reflect 0.5 0.5 0.5
material lamp reflect 0 0 0  emit 60 60 60
box wall  0 0 0  3 2 2  divide 5 inside
quad wall  1 0 0  1 0.96 0  1 0.96 2  1 0 2  divide 2 4 two-sided
quad wall  1 1.04 0  1 2 0  1 2 2  1 1.04 2  divide 2 4 two-sided
quad lamp  0.5 0.85 0.9  0.5 1.15 0.9  0.5 1.15 1.2  0.5 0.85 1.2  divide 2 2
view from 1.1 0.1 1 at 3 1 1 up 0 0 1 angle 70 size 40 30
)";

Room make_room(const char* text) {
  Room room = read(text);
  choose_creases(room, Creases::found);
  return room;
}

LightParams make_light() {
  LightParams light;
  light.mesh.refine = 2;
  light.solve.tolerance = 0.1;
  return light;
}

TEST(LitMesh, IsFinerWhereLightIsConcentrated) {
  const Room room = make_room(LAMP_BESIDE_A_WALL);
  const LightParams light = make_light();
  const AdaptedMesh adapted = make_lit_mesh(room, light);
  const Mesh even = make_mesh(room, light.mesh);
  const auto count = [](const Mesh& mesh) {  // counts the patches of the ceiling and of the floor
    std::array<std::size_t, 2> counts{};
    for (const Patch& patch : mesh.patches)
      if (patch.normal.z == -1 && patch.centre.z > 2.39)
        ++counts[0];
      else if (patch.normal.z == 1)
        ++counts[1];
    return counts;
  };
  const auto [ceiling, floor] = count(adapted.mesh);
  std::printf("ceiling %zu patches, %zu before; floor %zu, %zu before\n", ceiling, count(even)[0],
              floor, count(even)[1]);
  EXPECT_GT(adapted.rounds, 0);
  EXPECT_GT(ceiling, count(even)[0]);
  EXPECT_EQ(floor, count(even)[1]);

  // The view must have no effect on the mesh. solve_adapted() must give the same result as solve()
  // for this mesh.
  Room turned = room;
  turned.view.from = {0.3, 0.3, 0.1};
  AdaptedMesh other = make_lit_mesh(turned, light);
  ASSERT_EQ(other.mesh.patches.size(), adapted.mesh.patches.size());
  EXPECT_EQ(solve_adapted(turned, other, light).vertices,
            solve(adapted.mesh, light.solve).vertices);
}

TEST(LitMesh, IsMakeMeshsUnlessAsked) {
  Room room = make_room(LAMP_BESIDE_A_WALL);
  LightParams light = make_light();
  const auto check_plain = [&] {
    const AdaptedMesh lit = make_lit_mesh(room, light);
    EXPECT_EQ(lit.mesh.patches.size(), make_mesh(room, light.mesh).patches.size());
    EXPECT_EQ(lit.rounds, 0);
  };
  light.solve.mean = Mean::corners;
  check_plain();
  light = make_light();
  light.senders = 1;
  check_plain();
  light = make_light();
  room.fine_near_lights = false;
  check_plain();
}

// Through a slit, a vertex sees only a part of the lamp. Single rays cannot measure the size of
// this part.
TEST(FineShadows, LightBehindASlitHasNoStreaks) {
  Room room = make_room(SLIT);
  const Mesh mesh = make_mesh(room, {});
  room.fine_shadows = false;
  const Mesh coarse = make_mesh(room, {});
  const FactorParams params, exact{.samples = 64};
  const auto find_light = [&](const Mesh& of, const FactorParams& how, const Vertex& vertex) {
    double light = 0;
    renderer::Work work;
    for (const Patch& patch : of.patches)
      if (max_component(of.materials[patch.material].emission) > 0)
        light += eval_light({of, how}, vertex, {patch, Glow(Rgb{60, 60, 60})}, work).r;
    return light;
  };
  double worst = 0, before = 0, most = 0;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vertex& vertex = mesh.vertices[v];
    if (vertex.at.x < 2.99) continue;
    const double light = find_light(mesh, exact, vertex);
    most = std::max(most, light);
    worst = std::max(worst, std::abs(find_light(mesh, params, vertex) - light));
    before = std::max(before, std::abs(find_light(coarse, params, vertex) - light));
  }
  std::printf("light behind the slit %.4f at most, off by %.4f, without fine shadows by %.4f\n",
              most, worst, before);
  EXPECT_LT(worst, 0.1 * most);
  EXPECT_LT(worst, before / 4);
}

TEST(EstimatedError, FallsWithTheWidthOfPatches) {
  const Room room = read(LAMP_BESIDE_A_WALL);
  double last = 1;
  SolveParams rough;
  rough.tolerance = 0.02;
  for (const int refine : {1, 2}) {
    const Mesh mesh = make_mesh(room, {.refine = refine});
    const double error = estimate_error(mesh, solve(mesh, rough), rough, {}, room.view);
    std::printf("refine %d: estimated error %.2f %%\n", refine, 100 * error);
    EXPECT_LT(error, 0.7 * last);
    EXPECT_GT(error, 0);
    last = error;
  }
}

}  // namespace
}  // namespace radiosity::test
