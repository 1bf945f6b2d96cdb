// Tests properties of mirrors with any parameters: their sides, their colours, and that they lose
// no light.

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/light/unfold.hpp"

namespace radiosity::test {
namespace {

// The sum of the form factors of all patches, including paths via mirrors, for one colour.
double sum_by_mirrors(const Mesh& mesh, const Vertex& vertex, const FactorParams& params) {
  double total = 0;
  Work work;
  for (const Patch& patch : mesh.patches)
    total += eval_factors({mesh, params}, vertex, patch, work).r;
  return total;
}

TEST(Mirrors, ReflectAtTheirFrontOnly) {
  Room room = make_cube("xXyYzZ", true, 2);
  // the front of the mirror faces towards low x
  add_quad(room, 2, {0.3, 0.2, 0.1}, {0, 0, 1.5}, {0, 1.6, 0});
  const Mesh mesh = make_mesh(room, {});
  const Vec normal = mesh.mirrors.at(0).normal;
  int before = 0, behind = 0;
  for (const Vertex& vertex : mesh.vertices) {
    double reflected = 0;
    Work work;
    for (const Patch& patch : mesh.patches)
      reflected += eval_factors({mesh, {}}, vertex, patch, work).r -
                   eval_factor({mesh, {}}, vertex, patch, work);
    const bool is_before = dot(normal, vertex.lit - mesh.mirrors[0].corners[0]) > 0;
    if (!is_before) {
      EXPECT_EQ(reflected, 0);
    }
    behind += !is_before;
    before += is_before && reflected > 0;
  }
  EXPECT_GT(before, 10);
  EXPECT_GT(behind, 10);
  EXPECT_LT(normal.x, 0);
}

// One mirror multiplies light by its colour once, two mirrors do so twice.
TEST(Mirrors, ColourWhatTheyReflect) {
  Room room = make_cube("xyzZ", true, 1);
  add_walls(room, "XY", 1, 2);
  room.materials[2].reflectance = {0.5, 1, 0.2};
  const Mesh mesh = make_mesh(room, {});
  double once = 0, twice = 0;
  for (const Vertex& vertex : mesh.vertices)
    for (const Patch& patch : mesh.patches) {
      const auto eval = [&](int reflections) {
        Work work;
        return eval_factors({mesh, {.reflections = reflections}}, vertex, patch, work);
      };
      const Rgb none = eval(0), one = eval(1), two = eval(2);
      EXPECT_EQ(none, grey(none.g));
      EXPECT_NEAR(one.r - none.r, 0.5 * (one.g - none.g), 1e-12);
      EXPECT_NEAR(one.b - none.b, 0.2 * (one.g - none.g), 1e-12);
      EXPECT_NEAR(two.r - one.r, 0.25 * (two.g - one.g), 1e-12);
      EXPECT_NEAR(two.b - one.b, 0.04 * (two.g - one.g), 1e-12);
      once += one.g - none.g;
      twice += two.g - one.g;
    }
  EXPECT_GT(once, 1);
  EXPECT_GT(twice, 0.1);
}

// If a perfect mirror replaces a wall, a vertex still sees patches in all directions.
TEST(Mirrors, LoseNoLight) {
  for (const std::string mirrors : {"X", "XY"}) {
    Room room = make_cube(mirrors == "X" ? "xyYzZ" : "xyzZ", false, 2);
    add_walls(room, mirrors, 1, 2);
    const Mesh mesh = make_mesh(room, {});
    double mean = 0;
    for (const Vertex& vertex : mesh.vertices) {
      const double sum = sum_by_mirrors(mesh, vertex, {});
      EXPECT_NEAR(sum, 1, mirrors == "X" ? 0.01 : 0.03);
      mean += sum / static_cast<double>(mesh.vertices.size());
    }
    EXPECT_NEAR(mean, 1, 0.01);
  }
}

// If walls of a furnace are mirrors, their images are as bright as the walls were.
TEST(Mirrors, DoNotChangeAFurnace) {
  Room room = make_cube("xyYzZ", false, 2);
  add_walls(room, "X", 1, 2);
  room.materials[0] = room.materials[1] = {"wall", grey(0.5), grey(1)};
  const Mesh mesh = make_mesh(room, {});
  for (const Rgb& b : solve(mesh, make_params(1e-4)).vertices) EXPECT_NEAR(b.r, 2, 0.02);
}

// A parabolic trough of flat mirrors. At its focal line, z = 1, a point that looks down sees far
// more of a distant lamp than via one flat mirror, but its total light is not greater. Without
// mirror_share, a delta area wider than the view of a facet would count completely or not at all.
TEST(Mirrors, BentOnesFocusLight) {
  constexpr int FACETS = 16;
  Room room;
  room.materials = {
      {"wall", grey(0.5), {}}, {"lamp", grey(0), grey(1)}, {"mirror", grey(1), {}, true}};
  const auto add_gutter = [](Room& to, double focal) {
    for (int i = 0; i < FACETS; ++i) {
      const auto point = [&](int k) {
        const double x = -1 + 2.0 * k / FACETS;
        return Vec{x, -1, x * x / (4 * focal)};
      };
      add_quad(to, 2, point(i), point(i + 1) - point(i), {0, 2, 0});
    }
  };
  add_box(room, 0, {-1.001, -1.001, -0.001}, {1.001, 1.001, 6});
  add_quad(room, 1, {-0.2, -1, 5.9}, {0, 2, 0}, {0.4, 0, 0}, 4, 1);
  Room flat = room;
  add_gutter(room, 1);
  add_gutter(flat, 1e6);
  const Mesh bent = make_mesh(room, {}), plane = make_mesh(flat, {});
  // a point on the focal line that looks down into the mirrors
  const Vertex focus = make_point({0.02, 0.01, 1}, {0, 0, -1});
  const auto of_lamp = [&](const Mesh& mesh) {
    double total = 0;
    Work work;
    for (const Patch& patch : mesh.patches)
      if (patch.material == 1)
        total += eval_factors({mesh, {.spread = 0.02, .reflections = 1}}, focus, patch, work).r;
    return total;
  };
  EXPECT_GT(of_lamp(bent), 4 * of_lamp(plane));
  const auto sum_all = [&](double spread) {
    return sum_by_mirrors(bent, focus, {.spread = spread, .reflections = 2});
  };
  const double found = sum_all(0.18), fine = sum_all(0.02);
  EXPECT_NEAR(found, 1, 0.03);
  EXPECT_NEAR(fine, 1, 0.01);
  fmt::print("lamp {:.4f}, flat {:.4f}; all {:.4f}, with delta areas of 0.02 {:.4f}\n",
             of_lamp(bent), of_lamp(plane), found, fine);
}

}  // namespace
}  // namespace radiosity::test
