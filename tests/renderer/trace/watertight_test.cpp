// No ray passes between faces that share an edge or a vertex.
//
// TLAB_AIMED_RAYS sets the number of rays, by default some 300,000.

#include <gtest/gtest.h>

#include <cstdlib>

#include "renderer/scene/triangulate.hpp"
#include "renderer/trace/shadow_rays.hpp"
#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

// A closed surface; all of it is visible from near its middle.
struct Closed {
  std::vector<Vec> points;
  std::vector<std::vector<std::uint32_t>> faces;
  Vec middle;
  double size = 1;
};

std::uint32_t add_point(Closed& mesh, const Vec& point) {
  const auto index = std::ranges::find(mesh.points, point) - mesh.points.begin();
  if (index == std::ssize(mesh.points)) mesh.points.push_back(point);
  return static_cast<std::uint32_t>(index);
}

// A cube from -1 to 1, each side cut into side x side squares.
Closed make_cube(int side) {
  Closed mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double end : {-1.0, 1.0})
      for (int i = 0; i < side * side; ++i) {
        const auto at = [&](int u, int v) {
          const double a = 2.0 * u / side - 1, b = 2.0 * v / side - 1;
          return add_point(mesh, axis == 0   ? Vec{end, a, b}
                                 : axis == 1 ? Vec{a, end, b}
                                             : Vec{a, b, end});
        };
        const int u = i % side, v = i / side;
        mesh.faces.push_back({at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)});
      }
  return mesh;
}

// Rings of quads and two triangle fans. The radii vary by `vary`, so that quads are bent.
Closed make_ball(Random& random, int rings, int sectors, double vary = 0.1) {
  Closed mesh;
  const auto place = [&](double polar, double around) {
    const double r = random.range(1 - vary, 1 + vary);
    return Vec{r * std::sin(polar) * std::cos(around), r * std::sin(polar) * std::sin(around),
               r * std::cos(polar)};
  };
  mesh.points = {place(0, 0), place(std::numbers::pi, 0)};
  for (int i = 1; i < rings; ++i)
    for (int k = 0; k < sectors; ++k)
      mesh.points.push_back(
          place(std::numbers::pi * i / rings, 2 * std::numbers::pi * k / sectors));
  const auto at = [&](int i, int k) {
    return static_cast<std::uint32_t>(i == 0       ? 0
                                      : i == rings ? 1
                                                   : 2 + (i - 1) * sectors + k % sectors);
  };
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < sectors; ++k) {
      mesh.faces.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
      auto& face = mesh.faces.back();
      if (i == 0) face.pop_back();
      if (i == rings - 1) face.erase(face.begin() + 1);
    }
  return mesh;
}

// A prism over a star, mostly concave.
Closed make_prism(Random& random) {
  Closed mesh;
  const int corners = 3 + random.below(9);
  std::vector<std::uint32_t> bottom, top;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, r = random.range(0.7, 1.2);
    const Vec at{r * std::cos(angle), r * std::sin(angle), -0.8};
    bottom.push_back(add_point(mesh, at));
    top.push_back(add_point(mesh, at + Vec{0.1, 0.05, 1.6}));
  }
  mesh.faces = {bottom, top};
  for (std::size_t i = 0, j = bottom.size() - 1; i < bottom.size(); j = i++)
    mesh.faces.push_back({bottom[j], bottom[i], top[i], top[j]});
  return mesh;
}

std::vector<Vec> find_corners(const Closed& mesh, const std::vector<std::uint32_t>& face) {
  std::vector<Vec> corners;
  for (const auto i : face) corners.push_back(mesh.points[i]);
  return corners;
}

bool is_valid(const std::vector<Vec>& corners) {
  try {
    check_polygon(corners, {});
    return true;
  } catch (const base::BadInput&) {
    return false;
  }
}

// Splits some quads, and all that are too bent; turns some faces around.
void vary_faces(Random& random, Closed& mesh) {
  std::vector<std::vector<std::uint32_t>> faces;
  const bool splits = random.below(2) == 0;
  for (const auto& face : mesh.faces) {
    if (face.size() == 4 && (splits || !is_valid(find_corners(mesh, face)))) {
      faces.push_back({face[0], face[1], face[2]});
      faces.push_back({face[0], face[2], face[3]});
    } else {
      faces.push_back(face);
    }
  }
  for (auto& face : faces)
    if (random.below(2) == 0) std::ranges::reverse(face);
  mesh.faces = faces;
}

// Turns, scales and moves the mesh, unless it stays on the axes with round coordinates.
void place(Random& random, Closed& mesh) {
  if (random.below(4) == 0) return;
  const Vec n = random.direction();
  const auto [u, v] = make_plane(n);
  mesh.size = std::pow(10, random.range(-3, 3));
  mesh.middle = mesh.size * random.point(random.below(2) == 0 ? 1 : 1000);
  for (Vec& p : mesh.points)
    p = mesh.middle + (mesh.size * p.x) * u + (mesh.size * p.y) * v + (mesh.size * p.z) * n;
}

Closed make_closed(std::uint64_t seed) {
  Random random{seed};
  const int kind = random.below(3);
  Closed mesh = kind == 0   ? make_cube(1 + random.below(4))
                : kind == 1 ? make_ball(random, 3 + random.below(6), 5 + random.below(8))
                            : make_prism(random);
  place(random, mesh);
  vary_faces(random, mesh);
  return mesh;
}

// `patches`: with normals.
Scene make_scene(const Closed& mesh, bool patches, bool moves) {
  Scene scene;
  scene.surfaces.emplace_back();
  scene.view.from = mesh.middle + Vec{0, 0, 5 * mesh.size};
  scene.view.at = mesh.middle;
  for (const auto& face : mesh.faces) {
    const auto corners = find_corners(mesh, face);
    std::vector<Vec> normals;
    for (const Vec& corner : corners) normals.push_back(corner - mesh.middle);
    patches ? add_patch(scene, corners, normals) : add_polygon(scene, corners);
  }
  if (moves) scene.moves.assign(mesh.faces.size(), mesh.size * Vec{0.3, -0.2, 0.1});
  finish(scene);
  return scene;
}

// A ray to a shared place of several faces.
struct Aimed {
  Ray ray;
  double distance;
};

// A corner, or a point of an edge.
struct Target {
  Vec at;
  std::vector<std::uint32_t> corners;  // one or two
};

Target choose_target(Random& random, const Closed& mesh) {
  const auto& face = mesh.faces[static_cast<std::size_t>(random.below(int(mesh.faces.size())))];
  const auto i = static_cast<std::size_t>(random.below(static_cast<int>(face.size())));
  const std::uint32_t a = face[i], b = face[(i + 1) % face.size()];
  const Vec &p = mesh.points[a], &q = mesh.points[b];
  if (random.below(3) == 0) return {p, {a}};
  const double share = random.below(3) == 0 ? 0.5 : random.unit();
  return {p + share * (q - p), {a, b}};
}

// True if all faces at the target are seen clearly from the same side as the target.
bool is_in_front(const Closed& mesh, const Target& target, const Vec& origin) {
  for (const auto& face : mesh.faces) {
    const auto has = [&](std::uint32_t corner) {
      return std::ranges::find(face, corner) != face.end();
    };
    if (!std::ranges::all_of(target.corners, has)) continue;
    // Each corner counts, since the normal of a bent quad differs from corner to corner.
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

// Bent faces too reach as far as their edges: a ray that just misses an edge hits near it.
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

// The least angle that two faces enclose, radians.
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

// A prism over a triangle with an angle of 5 to 60 degrees.
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

// Mirrors all around: a ray that is reflected at an edge must meet the face beyond it. Returns the
// number of reflections before a ray leaves, or `most`.
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

// A corner reflector of two faces that moves far from the eye: rays near its edge are reflected
// twice.
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

// Rays from outside run in the plane of a cube's side, some along its borders. Sides that a ray
// meets edge-on must not hide the side behind them.
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

// Pictures in which a cube's edge or a square's diagonal lies exactly on samples.
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
