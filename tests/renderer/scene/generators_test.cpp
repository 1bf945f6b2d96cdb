// Tests the sphereflake, and scenes that are made by name.

#include <gtest/gtest.h>

#include "base/errors.hpp"
#include "renderer/files/load_scene.hpp"
#include "renderer/scene/generators.hpp"
#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

const Sphere& get_sphere(const Scene& scene, std::size_t number) {
  return scene.spheres[scene.objects[number + 1].index()];  // object 0 is the floor
}

TEST(Sphereflake, Definition) {
  const Scene scene = make_spheres(91);
  EXPECT_EQ(object_count(scene), 92u);
  EXPECT_EQ(scene.objects[0].kind(), Kind::polygon);
  const Sphere& root = get_sphere(scene, 0);
  EXPECT_EQ(root.centre, (Vec{0, 0, 0}));
  EXPECT_EQ(root.radius, 0.5);
  const Sphere& grandchild = get_sphere(scene, 10);  // first child of the first child
  EXPECT_EQ(grandchild.centre, (Vec{0.420314, 0.420314, 0.618405}));
  EXPECT_EQ(grandchild.radius, 0.0555556);
  EXPECT_EQ(scene.surfaces[root.tag.surface].ks, 0.5);
  EXPECT_EQ(scene.lights.size(), 3u);
}

TEST(Sphereflake, EachTouchesItsParent) {
  const Scene scene = make_spheres(7381);
  for (std::size_t i = 1; i < 7381; ++i) {
    const Sphere &child = get_sphere(scene, i), &parent = get_sphere(scene, (i - 1) / 9);
    ASSERT_NEAR(length(child.centre - parent.centre), child.radius + parent.radius, 3e-6) << i;
    ASSERT_NEAR(parent.radius, 3 * child.radius, 2e-6) << i;
  }
}

TEST(Sphereflake, OneMoreSphereIsOneMoreSphere) {
  const Scene some = make_spheres(57), more = make_spheres(58);
  for (std::size_t i = 0; i < 57; ++i)
    EXPECT_EQ(get_sphere(some, i).centre, get_sphere(more, i).centre);
}

TEST(Room, HasItsLightsWithin) {
  for (const int lights : {1, 2, 27, 30}) {
    const Scene scene = make_room(lights);
    ASSERT_EQ(scene.lights.size(), static_cast<std::size_t>(lights));
    double sum = 0;
    for (const Light& light : scene.lights) {
      EXPECT_TRUE(contains({{0, 0, 0}, {5, 5, 2.7}}, join(Bounds{}, light.at)));
      sum += light.intensity.g;
    }
    EXPECT_NEAR(sum, 1.2, 1e-12);
  }
}

TEST(LoadScene, ByName) {
  EXPECT_EQ(object_count(load_scene("spheres:10")), 11u);
  EXPECT_EQ(load_scene("room:27").lights.size(), 27u);
  EXPECT_EQ(object_count(load_scene("hills:77")), 77u);
  for (const char* wrong :
       {"spheres:0", "spheres:-5", "spheres:", "spheres:1e3", "spheres:2000001",
        "spheres:99999999999999999999", "spheres: 7", "cubes:3", "room:0", "room:", "room:10001",
        "hills:1", "hills:1000001", "", "x.obj", "/nowhere/x.nff", "/tmp/.nff"}) {
    SCOPED_TRACE(wrong);
    EXPECT_THROW(load_scene(wrong), base::BadInput);
  }
  const std::pair<const char*, const char*> errors[] = {
      {"cubes:3",
       "found scene 'cubes:3', expected a generator (spheres:N, room:L, hills:N) or a file (.nff, "
       ".obj)"},
      {"hills:1", "found hills:1, expected hills:N with N from 2 to 1000000"},
      {"hills:x", "found scene 'hills:x', expected hills:N with N from 2 to 1000000"}};
  for (const auto& [wrong, error] : errors) {
    try {
      load_scene(wrong);
      ADD_FAILURE() << wrong;
    } catch (const base::BadInput& bad) {
      EXPECT_STREQ(bad.what(), error);
    }
  }
}

}  // namespace
}  // namespace renderer::test
