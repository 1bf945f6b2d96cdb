// Tests rays in closed rooms whose walls are mirrors.
#include <gtest/gtest.h>

#include "tests/renderer/support.hpp"
#include "tests/renderer/trace/closed_mesh.hpp"

namespace renderer::test {
namespace {

// The smallest angle between two faces, in radians.
double find_sharpest(const Closed& mesh) {
  std::vector<Vec> inward;
  for (const auto& face : mesh.faces) {
    const Vec n = normalize(eval_area_normal(find_corners(mesh, face)));
    inward.push_back(dot(n, mesh.points[face[0]] - mesh.middle) > 0 ? -n : n);
  }
  double largest = -1;
  for (std::size_t a = 0; a < mesh.faces.size(); ++a)
    for (std::size_t b = 0; b < a; ++b) {
      const auto is_shared = [&](std::uint32_t corner) {
        return std::ranges::find(mesh.faces[b], corner) != mesh.faces[b].end();
      };
      if (std::ranges::count_if(mesh.faces[a], is_shared) == 2)
        largest = std::max(largest, -dot(inward[a], inward[b]));
    }
  return std::acos(std::min(1.0, largest));
}

void add_middle(Closed& mesh) {
  for (const Vec& p : mesh.points) mesh.middle += 1.0 / static_cast<double>(mesh.points.size()) * p;
}

// A prism over a triangle. One angle of the triangle is 5 to 60 degrees.
Closed make_wedge(Random& random) {
  Closed mesh;
  const double angle = std::numbers::pi / 180 * random.range(5, 60);
  const double longer = random.range(0.7, 1.3);
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {longer * std::cos(angle), longer * std::sin(angle), 0}};
  const Vec up{random.range(-0.3, 0.3), random.range(-0.3, 0.3), 1};
  for (std::size_t i = 0; i < 3; ++i) mesh.points.push_back(mesh.points[i] + up);
  mesh.faces = {{0, 1, 2}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}};
  add_middle(mesh);
  return mesh;
}

Closed make_tetrahedron(Random& random) {
  for (;;) {
    Closed mesh;
    for (int i = 0; i < 4; ++i) mesh.points.push_back(random.point(1));
    mesh.faces = {{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}};
    add_middle(mesh);
    if (find_sharpest(mesh) > std::numbers::pi / 36) return mesh;
  }
}

Closed make_convex(std::uint64_t seed) {
  Random random{seed};
  const int kind = random.below(4);
  Closed mesh = kind == 0   ? make_cube(1 + random.below(3))
                : kind == 1 ? make_wedge(random)
                : kind == 2 ? make_tetrahedron(random)
                            : make_ball(random, 3 + random.below(6), 5 + random.below(8), 0);
  const Vec middle = mesh.middle;
  for (Vec& p : mesh.points) p = p - middle;
  mesh.middle = {};
  place(random, mesh);
  vary_faces(random, mesh);
  return mesh;
}

// All walls are mirrors, so that a ray reflected at an edge must meet the face beyond the edge.
// Returns the number of reflections before the ray leaves the room, or `most` if it does not leave.
int count_bounces(const Scene& scene, Ray ray, int most) {
  for (int bounce = 0; bounce < most; ++bounce) {
    Work work;
    const auto hit = intersect(scene, ray, Traversal::nearest, work);
    if (!hit) return bounce;
    ray.origin = hit->point;
    ray.direction = reflect(ray.direction, hit->normal);
    ray.from = hit->object;
    ray.travelled += static_cast<float>(hit->distance);
  }
  return most;
}

Ray aim_from_inside(Random& random, const Closed& mesh) {
  const Target target = choose_target(random, mesh);
  const auto share = [&] { return random.unit(); };
  Vec origin = mesh.middle;
  for (int i = 0; i < 3; ++i)
    origin +=
        0.5 * share() *
        (mesh.points[static_cast<std::size_t>(random.below(static_cast<int>(mesh.points.size())))] -
         origin);
  return {.origin = origin, .direction = normalize(target.at - origin), .influence = {}};
}

TEST(Watertight, NoRayLeavesARoomOfMirrors) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Closed mesh = make_convex(seed);
    const Scene scene = make_scene(mesh, false, false);
    Random random{seed, 1000};
    for (int i = 0; i < 200; ++i)
      ASSERT_EQ(count_bounces(scene, aim_from_inside(random, mesh), 12), 12) << "ray " << i;
  }
}

// A room that moves far while the shutter is open.
TEST(Watertight, NoRayLeavesAMovingRoomOfMirrors) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Closed mesh = make_convex(seed);
    Scene scene = make_scene(mesh, false, false);
    Random random{seed, 1000};
    const Vec move = mesh.size * std::pow(10, random.range(-1, 4)) * random.direction();
    scene.moves.assign(mesh.faces.size(), move);
    finish(scene);
    for (int i = 0; i < 200; ++i) {
      Ray ray = aim_from_inside(random, mesh);
      ray.time = static_cast<float>(random.unit());
      ray.origin += eval_shift(scene, 0, ray.time);
      ASSERT_EQ(count_bounces(scene, ray, 8), 8) << "ray " << i;
    }
  }
}

// A corner reflector, which consists of two perpendicular mirrors, moves far away from the eye.
// Rays that arrive near the edge between the mirrors must be reflected twice.
TEST(Watertight, ARayIsReflectedTwiceAtAnEdgeThatMovedFar) {
  constexpr double FAR = 1e4;
  Scene scene;
  scene.surfaces.emplace_back();
  for (const double side : {-1.0, 1.0})
    add_polygon(scene, std::vector<Vec>{{1, 0, -1}, {1, 0, 1}, {0, side, 1}, {0, side, -1}});
  scene.moves.assign(2, {FAR, 0, 0});
  finish(scene);
  Random random{1};
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(testing::Message() << "ray " << i);
    const double beside = std::copysign(std::pow(10, random.range(-12, -4)), random.range(-1, 1));
    const Vec origin = 0.1 * random.point(1);
    const Vec target{FAR + 1 - std::abs(beside), beside, random.range(-0.9, 0.9)};
    Ray ray{.origin = origin, .direction = normalize(target - origin), .influence = {}};
    ray.time = 1;
    EXPECT_EQ(count_bounces(scene, ray, 8), 2);
  }
}

}  // namespace
}  // namespace renderer::test
