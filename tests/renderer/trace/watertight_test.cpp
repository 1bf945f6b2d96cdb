// Tests that no ray passes between faces that share an edge or a vertex.
//
// The environment variable TLAB_AIMED_RAYS sets the number of rays, by default some 300,000.

#include <gtest/gtest.h>

#include <cstdlib>

#include "renderer/trace/shadow_rays.hpp"
#include "tests/renderer/support.hpp"
#include "tests/renderer/trace/closed_mesh.hpp"

namespace renderer::test {
namespace {

// A ray towards a point that several faces share.
struct Aimed {
  Ray ray;
  double distance;
};

// True if `origin` is clearly outside the planes of all faces at the target.
bool is_in_front(const Closed& mesh, const Target& target, const Vec& origin) {
  for (const auto& face : mesh.faces) {
    const auto has = [&](std::uint32_t corner) {
      return std::ranges::find(face, corner) != face.end();
    };
    if (!std::ranges::all_of(target.corners, has)) continue;
    // Tests every corner, because the normal of a bent quad differs from corner to corner.
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Vec& p = mesh.points[face[i]];
      const Vec n = cross(mesh.points[face[(i + 1) % face.size()]] - p,
                          mesh.points[face[(i + face.size() - 1) % face.size()]] - p);
      const double out = dot(n, p - mesh.middle);
      if (!(std::copysign(1, out) * dot(n, origin - p) > 1e-3 * length(n) * length(origin - p)))
        return false;
    }
  }
  return true;
}

std::optional<Aimed> aim(Random& random, const Closed& mesh) {
  const Target target = choose_target(random, mesh);
  const bool inside = random.below(2) == 0;
  Vec origin = mesh.middle + (inside ? 0.1 : 4.0) * mesh.size * random.point(1);
  if (random.below(8) == 0) origin = mesh.middle;
  if (!inside && !is_in_front(mesh, target, origin)) return std::nullopt;
  const Vec way = target.at - origin;
  return Aimed{{.origin = origin, .direction = normalize(way), .influence = {}}, length(way)};
}

bool stops(const Scene& scene, const Aimed& aimed, Traversal traversal, RayKind kind) {
  Ray ray = aimed.ray;
  ray.kind = kind;
  ray.reach = kind == RayKind::shadow ? aimed.distance * (1 + 1e-6) : ray.reach;
  if (!scene.moves.empty()) {
    ray.time = 0.75F;
    ray.origin += eval_shift(scene, 0, ray.time);
  }
  Work work;
  const auto hit = intersect(scene, ray, traversal, work);
  return hit && hit->distance <= aimed.distance * (1 + 1e-6);
}

int count_passing(const Scene& scene, std::span<const Aimed> aimed) {
  ShadowRays rays{};
  for (std::size_t i = 0; i < LANES; ++i) {
    const auto& [ray, distance] = aimed[i];
    rays.origin.x[i] = ray.origin.x, rays.origin.y[i] = ray.origin.y;
    rays.origin.z[i] = ray.origin.z;
    rays.direction.x[i] = ray.direction.x, rays.direction.y[i] = ray.direction.y;
    rays.direction.z[i] = ray.direction.z;
    rays.reach[i] = distance * (1 + 1e-6);
    rays.from[i] = NO_OBJECT;
    rays.cast[i] = -1;
  }
  Work work;
  find_blocked(scene, rays, work);
  return static_cast<int>(LANES - count(rays.blocked));
}

int count_leaks(std::uint64_t seed, int number) {
  const Closed mesh = make_closed(seed);
  Random random{seed, 1'000'000};
  const Scene flat = make_scene(mesh, false, false), smooth = make_scene(mesh, true, false),
              moving = make_scene(mesh, seed % 2 == 0, true);
  std::vector<Aimed> all;
  int leaks = 0;
  const auto expect = [&](bool stopped) { leaks += !stopped; };
  while (static_cast<int>(all.size()) < number) {
    const auto aimed = aim(random, mesh);
    if (!aimed) continue;
    all.push_back(*aimed);
    for (const RayKind kind : {RayKind::primary, RayKind::shadow}) {
      expect(stops(flat, *aimed, Traversal::nearest, kind));
      expect(stops(smooth, *aimed, Traversal::exhaustive, kind));
    }
    expect(stops(flat, *aimed, Traversal::linear, RayKind::reflected));
    expect(stops(moving, *aimed, Traversal::nearest, RayKind::primary));
    if (all.size() % LANES == 0) leaks += count_passing(flat, std::span(all).last(LANES));
  }
  return leaks;
}

TEST(Watertight, NoRayPassesThroughASharedEdgeOrVertex) {
  constexpr int RAYS = 1000, TESTS = 7;
  const char* asked = std::getenv("TLAB_AIMED_RAYS");
  const auto meshes = asked ? std::strtoull(asked, nullptr, 10) / (RAYS * TESTS) : 40;
  ASSERT_GE(meshes, 1u) << "TLAB_AIMED_RAYS: expected a whole number from " << RAYS * TESTS;
  for (std::uint64_t seed = 1; seed <= meshes; ++seed) {
    ASSERT_EQ(count_leaks(seed, RAYS), 0) << "seed " << seed;
  }
}

// Bent faces must reach as far as their edges, too: a ray that just misses an edge must hit near
// it.
TEST(Watertight, FacesMeetAtTheirEdges) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Closed mesh = make_closed(seed);
    const Scene scene = make_scene(mesh, false, false);
    Random random{seed, 1000};
    for (int i = 0; i < 200; ++i) {
      const Target target = choose_target(random, mesh);
      const Vec origin = mesh.middle + 0.1 * mesh.size * random.point(1);
      const Vec way = target.at + 1e-7 * mesh.size * random.direction() - origin;
      const Ray ray{.origin = origin, .direction = normalize(way), .influence = {}};
      Work work;
      const auto hit = intersect(scene, ray, Traversal::nearest, work);
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->distance, length(way), 1e-5 * mesh.size);
    }
  }
}

// Rays from outside that run in the plane of a cube's side, some of them along its borders. A side
// that a ray meets edge-on must not hide the side behind it.
TEST(Watertight, RaysInThePlanesOfFaces) {
  const Scene scene = make_scene(make_cube(4), false, false);
  for (const double side : {-1.0, 1.0})
    for (int y = -4; y <= 4; ++y)
      for (int turn = 0; turn < 3; ++turn) {
        SCOPED_TRACE(testing::Message() << side << ", " << y << ", axis " << turn);
        const double start[] = {-3, y / 4.0, side}, way[] = {1, 0, 0};
        const auto axis = [&](const double* of, int i) { return of[(i + turn) % 3]; };
        const Ray ray{.origin = {axis(start, 0), axis(start, 1), axis(start, 2)},
                      .direction = {axis(way, 0), axis(way, 1), axis(way, 2)},
                      .influence = {}};
        const std::vector<Aimed> lanes(LANES, {ray, 3});
        Work work;
        const auto hit = intersect(scene, ray, Traversal::nearest, work);
        ASSERT_TRUE(hit);
        EXPECT_NEAR(hit->distance, 2, 1e-12);
        EXPECT_EQ(count_passing(scene, lanes), 0);
      }
}

// Pictures in which an edge of a cube or the diagonal of a square lies exactly on samples.
TEST(Watertight, NoPixelShowsTheBackgroundThroughAnEdge) {
  const auto count_seen_through = [](const Scene& scene, int side, int left, int width, int top,
                                     int height) {
    const Samples& samples = render(scene, make_params(side, side, 2)).samples;
    int seen = 0;
    for (int y = top; y < top + height; ++y)
      for (int x = left; x < left + width; ++x)
        seen += samples.sums[static_cast<std::size_t>(y * side + x)].b != 0;
    return seen;
  };
  const std::string cube =
      "v from 4 4 3 at 0 0 0 up 0 0 1 angle 40 hither 1 resolution 100 100\nb 0 0 1\nl 9 9 7\n"
      "f 1 0.5 0 1 0 0 0 1\n"
      "p 4 1 -1 -1  1 1 -1  1 1 1  1 -1 1\np 4 1 1 -1  -1 1 -1  -1 1 1  1 1 1\n";
  EXPECT_EQ(count_seen_through(parse(cube), 100, 45, 10, 50, 25), 0);
  std::string tiles =
      "v from 0 0 3 at 0 0 0 up 0 1 0 angle 67.38013505195957 hither 1 resolution 400 400\n"
      "b 0 0 1\nl 0 3 50\nf 1 0 0 1 0 0 0 1\n";
  for (int y = 0; y < 40; ++y)
    for (int x = 0; x < 40; ++x) {
      const double left = (x - 20) / 10.0, right = (x - 19) / 10.0;
      const double low = (y - 20) / 10.0, high = (y - 19) / 10.0;
      tiles +=
          fmt::format("p 3 {0} {2} 0  {1} {2} 0  {1} {3} 0\np 3 {0} {2} 0  {1} {3} 0  {0} {3} 0\n",
                      left, right, low, high);
    }
  EXPECT_EQ(count_seen_through(parse(tiles), 400, 1, 398, 1, 398), 0);
}

}  // namespace
}  // namespace renderer::test
