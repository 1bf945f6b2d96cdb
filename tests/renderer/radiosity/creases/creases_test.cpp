// Tests the creases of rooms by comparison with their known positions.

#include <gtest/gtest.h>

#include "renderer/radiosity/files/load_room.hpp"
#include "tests/renderer/radiosity/creases/creases.hpp"
#include "tests/support/places.hpp"

namespace radiosity::test::shadows {
namespace {

// Expects that the creases in `by` cover all of `creases`.
void expect_covered(std::span<const Crease> creases, std::span<const Crease> by, double tolerance) {
  for (const Crease& crease : creases)
    for (int i = 0; i <= 20; ++i) {
      const Vec p = crease.a + i / 20.0 * (crease.b - crease.a);
      ASSERT_LE(distance_to(p, by), tolerance) << p.x << ' ' << p.y << ' ' << p.z;
    }
}

// A square light of side 2 a at height h, and a square occluder of side 2 b at height g < h. Both
// have their centres above the origin.
TEST(Discontinuities, ParallelSquares) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const double a = random.range(0.2, 1), b = random.range(0.2, 1), h = random.range(2, 4),
                 g = random.range(0.5, 1);
    Room room = make_room();
    add_face(room, turn(make_rectangle(-a, -a, a, a, h)), LIGHT);
    add_face(room, make_rectangle(-b, -b, b, b, g), seed % 2 == 0 ? GREY : MIRROR);
    add_face(room, make_rectangle(-9, -9, 9, 9, 0), GREY);
    // By similar triangles: the position at which a line from the light's edge at x past the
    // occluder's edge at y meets the floor.
    const auto floor = [&](double x, double y) { return x + (y - x) * h / (h - g); };
    const double outer = floor(-a, b), inner = std::abs(floor(a, b));
    std::vector<Crease> expected;
    for (const double at : {-outer, -inner, inner, outer}) {
      expected.push_back({{at, -outer, 0}, {at, outer, 0}});
      expected.push_back({{-outer, at, 0}, {outer, at, 0}});
    }
    const std::vector<Crease> found = find_creases(room);
    ASSERT_EQ(found.size(), 8u);
    expect_covered(found, expected, 1e-9);
    // The complete border of the penumbra, and the sides of the square in which occlusion is
    // greatest.
    expected.resize(0);
    for (const double at : {-outer, outer}) {
      expected.push_back({{at, -outer, 0}, {at, outer, 0}});
      expected.push_back({{-outer, at, 0}, {outer, at, 0}});
    }
    for (const double at : {-inner, inner}) {
      expected.push_back({{at, -inner, 0}, {at, inner, 0}});
      expected.push_back({{-inner, at, 0}, {inner, at, 0}});
    }
    expect_covered(expected, found, 1e-9);
  }
}

// Two occluders hide one light each from a floor. The creases of the stronger light must come
// first.
TEST(Discontinuities, OfTheStrongestLightComeFirst) {
  for (const bool first_is_strong : {true, false}) {
    Room room = make_room();
    room.materials.push_back({"strong", {}, {100, 100, 100}, false});
    const auto strong = static_cast<std::uint32_t>(room.materials.size() - 1);
    add_face(room, turn(make_rectangle(-3, -1, -2, 0, 3)), first_is_strong ? strong : LIGHT);
    add_face(room, turn(make_rectangle(2, 0, 3, 1, 3)), first_is_strong ? LIGHT : strong);
    add_face(room, make_rectangle(-0.5, -0.4, 0.6, 0.5, 1), GREY);
    add_face(room, make_rectangle(-9, -9, 9, 9, 0), GREY);
    Room alone = room;
    for (Face& face : alone.faces)
      if (face.material == LIGHT) face.material = GREY;
    const auto on_floor = [](const Room& lit) {
      std::vector<Crease> found = find_creases(lit);
      std::erase_if(found, [](const Crease& crease) { return crease.a.z + crease.b.z > 1e-9; });
      return found;
    };
    const auto all = on_floor(room), strongest = on_floor(alone);
    ASSERT_GT(strongest.size(), 4u);
    ASSERT_GT(all.size(), strongest.size());
    expect_covered(std::span(all).first(strongest.size()), strongest, 1e-9);
    expect_covered(strongest, std::span(all).first(strongest.size()), 1e-9);
  }
}

// The room of figure 3.8, with a window in the left wall. Its walls cause no creases, but a hanging
// square does.
TEST(Discontinuities, WallsOfARoomMakeNone) {
  Room room = make_room();
  add_box(room, {0, 0, 0}, {4, 3, 3}, false);
  add_face(room, {{0, 1, 1}, {0, 2, 1}, {0, 2, 2}, {0, 1, 2}}, LIGHT);
  EXPECT_EQ(find_creases(room).size(), 0u);
  add_face(room, {{2, 1.2, 1.2}, {2, 1.2, 1.8}, {2, 1.8, 1.8}, {2, 1.8, 1.2}}, GREY, true);
  const auto creases = find_creases(room);
  EXPECT_EQ(creases.size(), 8u);
  for (const Crease& crease : creases) EXPECT_EQ(std::min(crease.a.x, crease.b.x), 4);
}

// A floor, and a light high above it.
Room make_floor() {
  Room room = make_room();
  add_face(room, make_rectangle(-5, -5, 5, 5, 0), GREY);
  add_face(room, turn(make_rectangle(-1, 1, 1, 2, 4)), LIGHT);
  return room;
}

// True if creases cover the whole segment from a to b.
bool is_crease(const Vec& a, const Vec& b, std::span<const Crease> creases) {
  for (int i = 0; i <= 20; ++i)
    if (distance_to(a + i / 20.0 * (b - a), creases) > 1e-3) return false;
  return true;
}

TEST(Discontinuities, WhereAScreenStandsOnTheFloor) {
  Room room = make_floor();
  add_face(room, {{-1, 0, 0}, {1, 0, 0}, {1, 0, 1}, {-1, 0, 1}}, GREY);
  EXPECT_TRUE(is_crease({-1, 0, 0}, {1, 0, 0}, find_creases(room)));
  // An occluder that extends below the floor causes the same creases as one that ends at the floor.
  room.faces.back().corners = {{-1, 0, -1}, {1, 0, -1}, {1, 0, 1}, {-1, 0, 1}};
  EXPECT_TRUE(is_crease({-1, 0, 0}, {1, 0, 0}, find_creases(room)));
}

// The penumbra of an upright edge is a fan from the foot of the edge. Inside the fan, lines mark
// where further corners of the lamp become visible. These lines must come after all borders.
TEST(Discontinuities, FromAFootOneGoesOutForEveryCornerOfTheLight) {
  Room room = make_room();
  add_face(room, make_rectangle(-5, -5, 5, 5, 0), GREY);
  add_face(room, turn(make_rectangle(-0.3, 1, 0.7, 2, 4)), LIGHT);
  add_face(room, {{-1, 0, 0}, {1, 0, 0}, {1, 0, 1}, {-1, 0, 1}}, GREY);
  const auto creases = find_creases(room);
  for (const double foot : {-1.0, 1.0})
    for (const Vec& corner : room.faces[1].corners) {
      // The lines are as long as the shadow of the upright edge. This edge is a quarter as high as
      // the lamp.
      const Vec end{foot + (foot - corner.x) / 3, -corner.y / 3, 0};
      EXPECT_TRUE(is_crease({foot, 0, 0}, end, creases)) << foot << ' ' << corner.x << corner.y;
    }
  const auto find = [&](double x, double y) {
    const Vec end{1 + (1 - x) / 3, -y / 3, 0};
    return std::ranges::find_if(creases, [&](const Crease& crease) {
      return crease.a.z == 0 && crease.b.z == 0 && is_crease({1, 0, 0}, end, std::array{crease});
    });
  };
  // The lines of those corners of the lamp that are outermost as seen from the foot come first.
  EXPECT_LT(find(-0.3, 1), find(-0.3, 2));
  EXPECT_LT(find(-0.3, 1), find(0.7, 1));
  EXPECT_LT(find(0.7, 2), find(-0.3, 2));
  EXPECT_LT(find(0.7, 2), find(0.7, 1));
}

TEST(Discontinuities, WhereAPanelsLightBegins) {
  Room room = make_floor();
  add_face(room, {{-5, 5, 0}, {5, 5, 0}, {5, 5, 6}, {-5, 5, 6}}, GREY);
  const auto creases = find_creases(room);
  EXPECT_EQ(creases.size(), 1u);
  EXPECT_TRUE(is_crease({-5, 5, 4}, {5, 5, 4}, creases));
}

TEST(Discontinuities, WhereAShelfIsSeenFromItsEdge) {
  Room room = make_room();
  add_face(room, {{0, -1, 1}, {0, 1, 1}, {0, 1, 2}, {0, -1, 2}}, LIGHT);
  add_face(room, {{6, -9, -9}, {6, -9, 9}, {6, 9, 9}, {6, 9, -9}}, GREY);
  add_face(room, make_rectangle(2, -1, 3, 1, 1.5), GREY);
  // At z = 1.5, the wall sees the shelf edge-on. Above and below that, the shelf hides a part of
  // the light.
  EXPECT_TRUE(is_crease({6, -5, 1.5}, {6, 5, 1.5}, find_creases(room)));
  EXPECT_FALSE(is_crease({6, -5.1, 1.5}, {6, 5.1, 1.5}, find_creases(room)));
}

TEST(Discontinuities, WhatIsHiddenOrTakesNoLightHasNone) {
  Room room = make_floor();
  add_face(room, make_rectangle(-2, 0, 2, 3, 3.5), GREY);
  const auto screen = find_creases(room);
  EXPECT_EQ(screen.size(), 0u);  // no crease touches the floor
  add_face(room, make_rectangle(-0.5, 1, 0.5, 2, 1), GREY);
  EXPECT_EQ(find_creases(room).size(), 0u);
  room.faces.erase(room.faces.begin() + 2);
  EXPECT_EQ(find_creases(room).size(), 8u);
  for (const std::uint32_t dark : {LIGHT, MIRROR}) {
    room.faces[0].material = dark;
    for (const Crease& crease : find_creases(room)) EXPECT_NE(crease.a.z, 0);
  }
}

// The files of these rooms list their creases, calculated by hand from formulas in the files.
TEST(Discontinuities, OfTheThesisFigures) {
  for (const char* name : {"window", "spot-diffuse", "spot-mirror"}) {
    SCOPED_TRACE(name);
    const Room room =
        load_room(::test::in_sources(std::string("experiments/scenes/") + name + ".room"));
    const auto found = find_creases(room);
    EXPECT_EQ(found.size(), 8u);
    expect_covered(found, room.creases, 1e-9);
    expect_covered(room.creases, found, 1e-3);
  }
}

}  // namespace
}  // namespace radiosity::test::shadows
