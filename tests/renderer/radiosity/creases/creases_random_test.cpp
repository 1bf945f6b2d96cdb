// Tests in random cases that creases lie exactly where the form of a light's visible part changes.

#include <gtest/gtest.h>

#include "renderer/radiosity/mesh/mesh.hpp"
#include "tests/renderer/radiosity/creases/creases.hpp"

namespace radiosity::test::shadows {
namespace {

// The part of a polygon on the left of the line from a to b.
Polygon clip(const Polygon& polygon, const Vec& a, const Vec& b) {
  Polygon part;
  const auto side = [&](const Vec& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const double here = side(p), there = side(q);
    if (here >= 0) part.push_back(p);
    if ((here > 0 && there < 0) || (here < 0 && there > 0))
      part.push_back(p + here / (here - there) * (q - p));
  }
  return part;
}

double eval_area(const Polygon& polygon) {
  return polygon.size() < 3 ? 0 : length(eval_area_normal(polygon)) / 2;
}

// A light and an occluder above a floor. Both are convex and slightly tilted.
struct Case {
  Polygon light, blocker;  // counter-clockwise as seen from above
  Room room = make_room();
};

Polygon make_convex(Random& random, double height) {
  const int corners = 3 + random.below(4);
  const double turn = random.unit(), size = random.range(0.5, 1.2);
  const double dx = random.range(-0.3, 0.3), dy = random.range(-0.3, 0.3);
  const double cx = random.range(-0.5, 0.5), cy = random.range(-0.5, 0.5);
  Polygon polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + turn + random.range(0, 0.5)) / corners;
    const double x = size * std::cos(angle), y = size * std::sin(angle);
    polygon.push_back({cx + x, cy + y, height + dx * x + dy * y});
  }
  return polygon;
}

Case make_case(std::uint64_t seed) {
  Random random{seed};
  Case c;
  c.light = make_convex(random, 4);
  c.blocker = make_convex(random, 1.8);
  add_face(c.room, make_rectangle(-6, -6, 6, 6, 0), GREY);
  add_face(c.room, c.blocker, GREY);
  add_face(c.room, turn(c.light), LIGHT);
  return c;
}

// Projects a polygon, as seen from a point of the floor, onto a plane at unit height.
Polygon project(const Polygon& polygon, const Vec& from) {
  Polygon image;
  for (const Vec& p : polygon) {
    const Vec d = p - from;
    image.push_back({d.x / d.z, d.y / d.z, 0});
  }
  return image;
}

enum class Seen { all, part, none };

Seen eval_seen(const Case& c, const Vec& from) {
  const Polygon light = project(c.light, from), blocker = project(c.blocker, from);
  Polygon hidden = light;
  for (std::size_t i = 0; i < blocker.size() && !hidden.empty(); ++i)
    hidden = clip(hidden, blocker[i], blocker[(i + 1) % blocker.size()]);
  const double area = eval_area(hidden), whole = eval_area(light);
  return area < 1e-10 * whole ? Seen::all : area > (1 - 1e-10) * whole ? Seen::none : Seen::part;
}

TEST(Discontinuities, LightChangesOnlyAtCreases) {
  int changes = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Case c = make_case(seed);
    const auto creases = find_creases(c.room);
    Random random{seed + 1000};
    for (int line = 0; line < 4; ++line) {
      const auto number = [&] { return random.range(-5, 5); };
      const double ax = number(), ay = number(), bx = number(), by = number();
      const Vec a{ax, ay, 0}, b{bx, by, 0};
      constexpr int STEPS = 300;
      for (int i = 0; i < STEPS; ++i) {
        Vec p = a + double(i) / STEPS * (b - a), q = a + double(i + 1) / STEPS * (b - a);
        const Seen at_p = eval_seen(c, p);
        if (at_p == eval_seen(c, q)) continue;
        for (int k = 0; k < 30; ++k) (eval_seen(c, 0.5 * (p + q)) == at_p ? p : q) = 0.5 * (p + q);
        ++changes;
        ASSERT_LE(distance_to(p, creases), 2e-3) << "at " << p.x << ' ' << p.y;
      }
    }
  }
  EXPECT_GT(changes, 300);
}

// One bit for each corner of the light and the occluder: whether it lies inside the other polygon,
// as seen from a point. The bits change exactly where the visible part of the light changes its
// form.
std::uint64_t eval_form(const Case& c, const Vec& from) {
  const Polygon light = project(c.light, from), blocker = project(c.blocker, from);
  std::uint64_t form = 0;
  const auto add = [&](const Vec& p, const Polygon& polygon) {
    bool inside = true;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      inside = inside && (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) > 0;
    }
    form = 2 * form + (inside ? 1 : 0);
  };
  for (const Vec& p : light) add(p, blocker);
  for (const Vec& p : blocker) add(p, light);
  return form;
}

TEST(Discontinuities, EveryCreaseIsAChange) {
  int all = 0;
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Case c = make_case(seed);
    Random random{seed + 2000};
    for (const Crease& crease : find_creases(c.room)) {
      const Vec p = crease.a + random.range(0.1, 0.9) * (crease.b - crease.a);
      const Vec across = normalize(cross(crease.b - crease.a, {0, 0, 1}));
      ++all;
      EXPECT_NE(eval_form(c, p + 1e-6 * across), eval_form(c, p - 1e-6 * across))
          << "at " << p.x << ' ' << p.y;
    }
  }
  EXPECT_GT(all, 2000);
}

TEST(Discontinuities, HalvesMakeTheCreasesOfTheWhole) {
  int points = 0, missing = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Case c = make_case(seed);
    const auto whole = find_creases(c.room);
    Random random{seed + 3000};
    const Polygon& b = c.blocker;
    const double s = random.range(0.2, 0.8), t = random.range(0.2, 0.8);
    const Vec from = b[0] + s * (b[1] - b[0]), to = b[2] + t * (b[0] - b[2]);
    Polygon one{from, b[1], b[2]}, other{b[0], from};
    if (b.size() == 3) {
      one.push_back(to);
      other.push_back(to);
    } else {
      const Vec third = b[2] + t * (b[3] - b[2]);
      one.push_back(third);
      other.push_back(third);
      other.insert(other.end(), b.begin() + 3, b.end());
    }
    c.room.faces[1].corners = one;
    add_face(c.room, other, GREY);
    const auto halves = find_creases(c.room);
    const auto on_floor = [](std::vector<Crease> creases) {
      std::erase_if(creases,
                    [](const Crease& x) { return std::abs(x.a.z) + std::abs(x.b.z) > 1e-6; });
      return creases;
    };
    for (const auto& [some, others] : {std::pair{whole, halves}, std::pair{halves, whole}})
      for (const Crease& crease : on_floor(some))
        for (int i = 0; i <= 20; ++i, ++points)
          if (distance_to(crease.a + i / 20.0 * (crease.b - crease.a), on_floor(others)) > 1e-2)
            ++missing;
  }
  // The ends of creases may be missing, so a few points need not be covered.
  EXPECT_LT(missing, points / 500) << "of " << points;
}

// True if the face blocks the line between two points.
bool blocks(const Face& face, const Vec& from, const Vec& to) {
  const Vec normal = eval_area_normal(face.corners);
  const double here = dot(normal, from - face.corners[0]),
               there = dot(normal, to - face.corners[0]);
  if ((here > 0) == (there > 0)) return false;
  const Vec p = from + here / (here - there) * (to - from);
  for (std::size_t i = 0; i < face.corners.size(); ++i) {
    const Vec &a = face.corners[i], &b = face.corners[(i + 1) % face.corners.size()];
    if (dot(normal, cross(b - a, p - a)) < 0) return false;
  }
  return true;
}

// Boxes stand on a floor, and one hangs in the air. Regions of full light and of full shadow must
// end at creases.
TEST(Discontinuities, BoxesShadowsEndAtCreases) {
  int changes = 0;
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Room room = make_room();
    add_face(room, make_rectangle(-6, -6, 6, 6, 0), GREY);
    for (const double z : {0.0, 0.0, 1.5}) {
      const double x = random.range(-2, 2), y = random.range(-2, 2);
      const Vec lo{x, y, z};
      const double dx = random.range(0.4, 1), dy = random.range(0.4, 1);
      add_box(room, lo, lo + Vec{dx, dy, random.range(0.4, 1)}, true);
    }
    const Polygon light = make_convex(random, 4);
    add_face(room, turn(light), LIGHT);
    const auto creases = find_creases(room);
    ASSERT_LT(creases.size(), 300u);
    // Points on the border of the light, denser near its corners.
    std::vector<Vec> border;
    for (std::size_t i = 0; i < light.size(); ++i)
      for (int k = 0; k < 24; ++k)
        border.push_back(light[i] + k / 24.0 * (light[(i + 1) % light.size()] - light[i]));
    const auto is_lit = [&](const Vec& p) {
      for (std::size_t i = 1; i + 1 < room.faces.size(); ++i)
        for (const Vec& q : border)
          if (blocks(room.faces[i], p, q)) return false;
      return true;
    };
    for (int line = 0; line < 4; ++line) {
      const auto number = [&] { return random.range(-4, 4); };
      const double ax = number(), ay = number(), bx = number(), by = number();
      const Vec a{ax, ay, 0}, b{bx, by, 0};
      for (int i = 0; i < 60; ++i) {
        Vec p = a + i / 60.0 * (b - a), q = a + (i + 1) / 60.0 * (b - a);
        const bool lit = is_lit(p);
        if (lit == is_lit(q)) continue;
        for (int k = 0; k < 20; ++k) (is_lit(0.5 * (p + q)) == lit ? p : q) = 0.5 * (p + q);
        ++changes;
        // The points on the light's border are 0.05 apart.
        ASSERT_LE(distance_to(p, creases), 0.05) << "at " << p.x << ' ' << p.y;
      }
    }
  }
  EXPECT_GT(changes, 60);
}

// Rectangles on a coarse grid, and triangles. The faces touch and cross each other in every way.
TEST(Discontinuities, AnyFacesCanBeMeshed) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Room room = make_room();
    double area = 0;
    for (int i = 0; i < 12; ++i) {
      const auto whole = [&] { return double(random.below(4)); };
      Vec o{whole(), whole(), whole()};
      const Vec axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      const int axis = random.below(3);
      const Vec u = (1.0 + random.below(2)) * axes[axis];
      const Vec v = (1.0 + random.below(2)) * axes[(axis + 1 + random.below(2)) % 3];
      if (i % 3 == 0)
        add_face(room, {random.point(2), random.point(2), random.point(2)}, i == 0 ? LIGHT : GREY);
      else
        add_face(room, {o, o + u, o + u + v, o + v}, i == 1 ? LIGHT : GREY, i % 4 == 2);
      area += eval_area(room.faces.back().corners) * (room.faces.back().two_sided ? 2 : 1);
    }
    room.creases = find_creases(room);
    for (const Crease& crease : room.creases) {
      bool is_in_a_face = false;
      for (const Face& face : room.faces) {
        const Vec n = normalize(eval_area_normal(face.corners));
        is_in_a_face = is_in_a_face || (std::abs(dot(n, crease.a - face.corners[0])) < 1e-6 &&
                                        std::abs(dot(n, crease.b - face.corners[0])) < 1e-6);
      }
      EXPECT_TRUE(is_in_a_face);
    }
    EXPECT_NEAR(make_mesh(room, {}).area, area, 1e-9 * area);
  }
}

TEST(Discontinuities, AreTheSameTwice) {
  const Case c = make_case(5);
  const auto one = find_creases(c.room), two = find_creases(c.room);
  ASSERT_EQ(one.size(), two.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].a, two[i].a);
    EXPECT_EQ(one[i].b, two[i].b);
  }
}

}  // namespace
}  // namespace radiosity::test::shadows
