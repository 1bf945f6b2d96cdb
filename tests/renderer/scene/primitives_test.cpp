// Tests the intersection of rays with each primitive by comparison with an independent method.

#include <gtest/gtest.h>

#include "renderer/scene/primitives.hpp"
#include "tests/renderer/support.hpp"

namespace renderer::test {
namespace {

Scene make_scene_of(const std::function<void(Scene&)>& add) {
  Scene scene;
  scene.surfaces.push_back({});
  scene.view.from = {0, 0, 5};
  add(scene);
  finish(scene);
  return scene;
}

std::optional<Hit> meet(const Scene& scene, const Vec& origin, const Vec& direction,
                        std::uint32_t from = NO_OBJECT) {
  Work work;
  return intersect(scene, {.origin = origin, .direction = direction, .influence = {}, .from = from},
                   Traversal::nearest, work);
}

// A surface: the points where `value` is zero and `exists` is true.
struct Implicit {
  std::function<double(const Vec&)> value;
  std::function<bool(const Vec&)> exists = [](const Vec&) { return true; };
};

// The first change of sign along the ray, found by small steps and bisection.
std::optional<double> march(const Implicit& f, const Vec& origin, const Vec& direction) {
  constexpr double STEP = 0.004, END = 12;
  for (double t = 0; t < END; t += STEP) {
    double lo = t, hi = t + STEP;
    const bool negative = f.value(origin + lo * direction) < 0;
    if (negative == (f.value(origin + hi * direction) < 0)) continue;
    for (int i = 0; i < 60; ++i) {
      const double middle = (lo + hi) / 2;
      (negative == (f.value(origin + middle * direction) < 0) ? lo : hi) = middle;
    }
    if (f.exists(origin + lo * direction)) return lo;
  }
  return std::nullopt;
}

void expect_as_implicit(const Scene& scene, const Implicit& f, Random& random) {
  int hits = 0, disagreements = 0;
  for (int i = 0; i < 200; ++i) {
    const Vec origin = random.point(3);
    const Vec direction = normalize(random.point(0.8) - origin);
    const std::optional<double> expected = march(f, origin, direction);
    const std::optional<Hit> hit = meet(scene, origin, direction);
    // The steps can miss two intersections that are close to each other, where the ray grazes the
    // surface.
    if (expected.has_value() != hit.has_value() ||
        (hit && std::abs(hit->distance - *expected) > 1e-6)) {
      ++disagreements;
      continue;
    }
    if (!hit) continue;
    ++hits;
    constexpr double D = 1e-6;
    const auto slope = [&](const Vec& step) {
      return (f.value(hit->point + step) - f.value(hit->point - step)) / (2 * D);
    };
    const Vec gradient = normalize(Vec{slope({D, 0, 0}), slope({0, D, 0}), slope({0, 0, D})});
    EXPECT_NEAR(f.value(hit->point), 0, 1e-9);
    EXPECT_NEAR(length(hit->normal), 1, 1e-12);
    EXPECT_NEAR(std::abs(dot(hit->normal, gradient)), 1, 1e-6);
    EXPECT_LE(dot(hit->normal, direction), 0) << "the normal is on the ray's side";
    EXPECT_EQ(hit->inside, dot(gradient, direction) > 0);
  }
  EXPECT_GT(hits, 25);
  EXPECT_LE(disagreements, 2);
}

TEST(Primitives, Sphere) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Vec centre = random.point(0.5);
    const double radius = random.range(0.5, 1.5);
    const Scene scene = make_scene_of([&](Scene& s) { add_sphere(s, centre, radius); });
    expect_as_implicit(scene, {[&](const Vec& p) { return length(p - centre) - radius; }}, random);
  }
}

TEST(Primitives, ConeAndCylinder) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Vec base = random.point(0.5), axis = random.direction();
    const double height = random.range(1, 2);
    const double from = seed == 1 ? 0 : random.range(0.3, 1);
    const double to = seed == 2 ? 0 : seed == 3 ? from : random.range(0.3, 1);
    const Scene scene =
        make_scene_of([&](Scene& s) { add_cone(s, base, from, base + height * axis, to); });
    const auto along = [&](const Vec& p) { return dot(p - base, axis); };
    expect_as_implicit(scene,
                       {[&](const Vec& p) {
                          return length(p - base - along(p) * axis) -
                                 (from + (to - from) * along(p) / height);
                        },
                        [&](const Vec& p) { return along(p) >= 0 && along(p) <= height; }},
                       random);
  }
}

// The angle that the polygon's corners describe around `p`: 2 pi inside, 0 outside.
double eval_winding(const std::vector<Vec>& corners, const Vec& p, const Vec& n) {
  double sum = 0;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Vec a = corners[j] - p, b = corners[i] - p;
    sum += std::atan2(dot(cross(a, b), n), dot(a, b));
  }
  return std::abs(sum);
}

TEST(Primitives, PolygonsConvexAndConcave) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Vec centre = random.point(1);
    const std::vector<Vec> star = make_star(random, centre, 1.5);
    const Scene scene = make_scene_of([&](Scene& s) { add_polygon(s, star); });
    const Vec n = scene.polygons[0].normal;
    for (const Vec& corner : star) EXPECT_NEAR(dot(n, corner - centre), 0, 1e-12);
    EXPECT_GT(dot(cross(star[0] - centre, star[1] - centre), n), 0) << "counter-clockwise";
    for (int i = 0; i < 100; ++i) {
      const auto [u, v] = make_plane(n);
      const Vec target = centre + random.range(-1.5, 1.5) * u + random.range(-1.5, 1.5) * v;
      const Vec origin = target + random.range(0.5, 2) * random.direction();
      const bool expected = eval_winding(star, target, n) > std::numbers::pi;
      const std::optional<Hit> hit = meet(scene, origin, normalize(target - origin));
      ASSERT_EQ(hit.has_value(), expected);
      if (!hit) continue;
      EXPECT_NEAR(length(hit->point - target), 0, 1e-9);
      EXPECT_NEAR(std::abs(dot(hit->normal, n)), 1, 1e-12);
      EXPECT_EQ(hit->inside, dot(target - origin, n) > 0);
    }
  }
}

TEST(Primitives, NeighbouringPolygonsLeaveNoGap) {
  // The triangles form a fan around a shared corner. No ray may pass between two of them.
  Random random{5};
  const Scene scene = make_scene_of([&](Scene& s) {
    for (int i = 0; i < 7; ++i) {
      const double a = 2 * std::numbers::pi * i / 7, b = 2 * std::numbers::pi * ((i + 1) % 7) / 7;
      add_polygon(
          s, std::array<Vec, 3>{
                 {{0.1, 0.2, 0}, {std::cos(a), std::sin(a), 0}, {std::cos(b), std::sin(b), 0}}});
    }
  });
  for (int i = 0; i < 2000; ++i) {
    // Aims at the edges that triangles share.
    const double a = 2 * std::numbers::pi * random.below(7) / 7, along = random.range(0, 0.9);
    const Vec corner{std::cos(a), std::sin(a), 0}, shared{0.1, 0.2, 0};
    const Vec target = shared + along * (corner - shared), origin = random.point(1) + Vec{0, 0, 3};
    EXPECT_TRUE(meet(scene, origin, normalize(target - origin)));
  }
}

// The rounding errors of the test grow with the coordinates of the polygon.
TEST(Primitives, MovedPolygonsAreAsThoseMadeThere) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    std::vector<Vec> corners = {random.point(1), random.point(1), random.point(1)};
    const Vec by = random.point(std::pow(10, random.range(0, 8)));
    std::vector<PolygonCorner> pool;
    Polygon moved = make_polygon(corners, {}, pool);
    translate(moved, by, pool);
    for (Vec& corner : corners) corner += by;
    const Polygon there = make_polygon(corners, {}, pool);
    EXPECT_GE(moved.slack, 0.999 * there.slack);
    EXPECT_LE(moved.slack, 3.01 * there.slack + 1e-8);
    const double rounding = 1e-13 * (1 + max_abs(by));
    for (std::size_t i = 0; i < 3; ++i) {
      const Line &edge = pool[i].edge, &same = pool[there.first + i].edge;
      // The triangle's projections along two axes are equally good.
      if (moved.w != there.w) continue;
      EXPECT_NEAR(edge.normal_u, same.normal_u, 1e3 * rounding);
      EXPECT_NEAR(edge.normal_v, same.normal_v, 1e3 * rounding);
    }
  }
}

TEST(Primitives, PatchNormalsAreInterpolated) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const std::vector<Vec> star = make_star(random, {0, 0, 0}, 1.5);
    // interpolation in a triangle is barycentric
    const std::vector<Vec> corners(star.begin(), star.begin() + 3);
    const Vec n = normalize(cross(corners[1] - corners[0], corners[2] - corners[0]));
    std::vector<Vec> normals;
    for (int i = 0; i < 3; ++i) normals.push_back(normalize(n + 0.5 * random.direction()));
    const Scene scene = make_scene_of([&](Scene& s) { add_patch(s, corners, normals); });
    for (int i = 0; i < 50; ++i) {
      double a = random.unit(), b = random.unit();
      if (a + b > 1) a = 1 - a, b = 1 - b;
      const double c = 1 - a - b;
      const Vec target = a * corners[0] + b * corners[1] + c * corners[2];
      const Vec expected = normalize(a * normals[0] + b * normals[1] + c * normals[2]);
      const std::optional<Hit> above = meet(scene, target + n, -n),
                               below = meet(scene, target - n, n);
      ASSERT_TRUE(above && below);
      EXPECT_NEAR(length(above->normal - expected), 0, 1e-9);
      EXPECT_NEAR(length(below->normal + expected), 0, 1e-9);
      EXPECT_FALSE(above->inside);
      EXPECT_TRUE(below->inside);
    }
  }
}

TEST(Primitives, PatchNormalsAtEdgesAndCorners) {
  const std::vector<Vec> corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  // The normals have z < 0, so that the front is on the side of low z, for any order of the
  // corners.
  const std::vector<Vec> normals = {{0, 0, -2}, normalize({1, 0, -1}), normalize({0, 1, -1})};
  const Scene scene = make_scene_of([&](Scene& s) { add_patch(s, corners, normals); });
  const auto at = [&](double x, double y) { return meet(scene, {x, y, -1}, {0, 0, 1}); };
  ASSERT_TRUE(at(0, 0) && at(0.25, 0));
  EXPECT_EQ(at(0, 0)->normal, (Vec{0, 0, -1}));
  EXPECT_NEAR(length(at(0.25, 0)->normal - normalize(0.75 * Vec{0, 0, -1} + 0.25 * normals[1])), 0,
              1e-12);
  EXPECT_FALSE(at(0.25, 0)->inside);
  EXPECT_TRUE(meet(scene, {0.25, 0.25, 1}, {0, 0, -1})->inside);
}

TEST(Primitives, ARayDoesNotMeetWhereItStarts) {
  Random random{11};
  for (const double radius : {1e-6, 1.0, 1e6}) {
    SCOPED_TRACE(testing::Message() << "radius " << radius);
    const Scene scene = make_scene_of([&](Scene& s) { add_sphere(s, {0, 0, 0}, radius); });
    for (int i = 0; i < 1000; ++i) {
      const Vec n = random.direction(), out = random.direction(), start = radius * n;
      const double cosine = dot(out, n);
      const std::optional<Hit> hit = meet(scene, start, out, 0);
      if (cosine > 1e-9) {
        EXPECT_FALSE(hit) << "leaves the sphere";
      }
      if (cosine < -1e-2) {
        ASSERT_TRUE(hit) << "crosses the sphere";
        EXPECT_NEAR(hit->distance, -2 * radius * cosine, 1e-9 * radius);
      }
    }
  }
}

// Rounding errors grow with the largest coordinate, so that the farthest position of the eye
// counts.
TEST(Scene, ToleranceFollowsTheFarthestPlaceOfTheEye) {
  const auto epsilon = [](const Vec& from, const Vec& move) {
    Scene scene;
    scene.surfaces.push_back({});
    scene.view.from = from;
    scene.view.from_move = move;
    add_sphere(scene, {0, 0, 0}, 1);
    finish(scene);
    return scene.epsilon;
  };
  const Vec near{0, 0, 5}, far{0, 0, 640};
  const double largest = epsilon(far, {});
  EXPECT_NEAR(largest / epsilon(near, {}), 640 / 5.0, 1e-9);
  EXPECT_EQ(epsilon(near, far - near), largest);
  EXPECT_EQ(epsilon(far, near - far), largest);
}

}  // namespace
}  // namespace renderer::test
