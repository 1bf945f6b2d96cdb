// Tests the energy balance of rooms, and that closed rooms lose no light.

#include "renderer/radiosity/light/balance.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

// A grey box in which one patch, in the plane of the ceiling, emits light.
Room make_closed() {
  Room room;
  room.materials = {{"grey", grey(0.5), {}}, {"lamp", {}, grey(10)}, {"glass", grey(0.9), {}}};
  room.materials[2].mirror = true;
  add_box(room, 0, {0, 0, 0}, {2, 2, 2}, 2);
  room.faces.erase(room.faces.begin() + 1);
  add_quad(room, 1, {0, 0, 2}, {0, 2, 0}, {1, 0, 0}, 2, 2);
  add_quad(room, 0, {1, 0, 2}, {0, 2, 0}, {1, 0, 0}, 2, 2);
  return room;
}

Balance light(const Room& room) {
  const Solution solution = solve(make_mesh(room, {}), {});
  const Balance& balance = solution.balance;
  EXPECT_NEAR(balance.absorbed + balance.unsent + balance.escaped, 1, 1e-12);
  EXPECT_LE(balance.unsent, SolveParams{}.tolerance);
  EXPECT_GT(balance.reflected, 0);
  return balance;
}

TEST(Balance, NothingEscapesFromAClosedRoom) {
  const Room room = make_closed();
  EXPECT_TRUE(is_closed(make_mesh(room, {})));
  EXPECT_LT(std::abs(light(room).escaped), 0.005);
}

TEST(Balance, AHoleAMirrorAndABackOpenARoom) {
  const double whole = light(make_closed()).absorbed;
  const auto expect_open = [&](const Room& room) {
    EXPECT_FALSE(is_closed(make_mesh(room, {})));
    const Balance balance = light(room);
    EXPECT_GT(balance.escaped, 0.05);
    EXPECT_LT(balance.absorbed, whole - 0.05);
  };
  for (std::size_t wall = 0; wall < 5; ++wall) {
    SCOPED_TRACE(testing::Message() << "wall " << wall);
    Room hole = make_closed(), back = make_closed();
    hole.faces.erase(hole.faces.begin() + static_cast<std::ptrdiff_t>(wall));
    expect_open(hole);
    back.faces[wall] = turn(back.faces[wall]);
    expect_open(back);
  }
  Room mirror = make_closed();
  mirror.faces[2].material = 2;
  EXPECT_FALSE(is_closed(make_mesh(mirror, {})));
}

// A room with a wall inside is still closed. Light on the wall's back is reported separately from
// lost light.
TEST(Balance, AWallInsideDoesNotOpenARoom) {
  Room room = make_closed();
  add_quad(room, 0, {1, 0, 0}, {0, 2, 0}, {0, 0, 2}, 2, 2);
  EXPECT_TRUE(is_closed(make_mesh(room, {})));
  const Balance balance = light(room);
  EXPECT_GT(balance.backs, 0.1);
  EXPECT_NEAR(balance.escaped, balance.backs, 0.01);
  room.faces.back().two_sided = true;
  EXPECT_TRUE(is_closed(make_mesh(room, {})));
  EXPECT_EQ(light(room).backs, 0);
}

// Rooms with hanging lamps and standing blocks are closed. Only a hole in the outer walls opens a
// room.
TEST(Balance, FreeStandingFacesDoNotOpenARoom) {
  for (const double below : {0.05, 0.3, 1.0}) {
    SCOPED_TRACE(testing::Message() << "lamp " << below << " m below the ceiling");
    Room room;
    room.materials = {{"grey", grey(0.6), {}}, {"lamp", grey(0), grey(10)}};
    add_box(room, 0, {0, 0, 0}, {3, 3, 2.5}, 12);
    add_block(room, 0, {0.5, 0.5, 0}, {1, 1.2, 0.8}, 4);
    add_quad(room, 1, {1.2, 1.2, 2.5 - below}, {0, 0.6, 0}, {0.6, 0, 0}, 3, 3);
    EXPECT_TRUE(is_closed(make_mesh(room, {})));
    const Balance balance = light(room);
    EXPECT_NEAR(balance.escaped, balance.backs, 0.01);
    room.faces.erase(room.faces.begin() + 3);
    EXPECT_FALSE(is_closed(make_mesh(room, {})));
  }
}

// A room with a lamp of 1.2 x 0.9 in the ceiling, or below it. The whole room is rotated and moved.
Room make_lamp_room(std::uint64_t seed, double below, int patches) {
  renderer::test::Random random{seed};
  Room room;
  room.materials = {{"wall", grey(0.9), {}}, {"lamp", {}, grey(10)}};
  add_box(room, 0, {0, 0, 0}, {4, 3, 2.5}, patches);
  const Vec corner{random.range(0, 2.8), random.range(0, 2.1), 2.5 - below};
  add_quad(room, 1, corner, {0, 0.9, 0}, {1.2, 0, 0}, 2, 2);
  if (seed % 2 == 0) return room;
  const Vec n = random.direction(), by = random.point(20);
  const auto [u, v] = renderer::test::make_plane(n);
  for (Face& face : room.faces)
    for (Vec& p : face.corners) p = by + p.x * u + p.y * v + p.z * n;
  return room;
}

// Casts rays from inside the room to corners and edges of its first six faces.
void expect_closed(const Room& room, const renderer::Scene& blockers,
                   renderer::test::Random& random) {
  Vec middle;
  for (std::size_t f = 0; f < 6; ++f) middle += (1 / 6.0) * eval_centre(room.faces[f].corners);
  for (std::size_t f = 0; f < 6; ++f)
    for (std::size_t i = 0; i < 4; ++i)
      for (const double share : {0.0, 0.5, random.unit()}) {
        const auto& corners = room.faces[f].corners;
        const Vec target = corners[i] + share * (corners[(i + 1) % 4] - corners[i]);
        const Vec origin = middle + random.point(1), way = target - origin;
        const renderer::Ray ray{.origin = origin, .direction = normalize(way), .influence = {}};
        renderer::Work work;
        const auto hit = intersect(blockers, ray, renderer::Traversal::nearest, work);
        ASSERT_TRUE(hit && hit->distance <= length(way) * (1 + 1e-5));
      }
}

TEST(Balance, NoRayLeavesAClosedRoomBetweenItsFaces) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Room room = make_lamp_room(seed, 0.1, 3);
    renderer::test::Random random{seed};
    expect_closed(room, make_mesh(room, {}).blockers, random);
  }
}

// The largest distance of a corner from the plane of its face, relative to the face's size.
double find_bend(const Room& room) {
  double bend = 0;
  for (const Face& face : room.faces) {
    const auto bounds = renderer::make_bounds(face.corners);
    const Vec normal = normalize(eval_area_normal(face.corners));
    const Vec middle = eval_centre(face.corners);
    for (const Vec& p : face.corners)
      bend = std::max(bend, std::abs(dot(normal, p - middle)) / length(bounds.hi - bounds.lo));
  }
  return bend;
}

// A box whose corners are moved at random, so that its faces are bent by 1e-6 of their size.
Room make_bent_room(std::uint64_t seed) {
  const auto make = [&](double by) {
    Room room = make_lamp_room(seed, 0.1, 3);
    room.faces.pop_back();
    const auto swing = [](double x) { return std::sin(1000 * x); };
    for (Face& face : room.faces)
      for (Vec& p : face.corners)
        p += by * Vec{swing(p.y + 2 * p.z), swing(p.z - p.x), swing(p.x + 3 * p.y)};
    return room;
  };
  constexpr double SMALL = 1e-6, MOST = 0.95e-6;
  return make(SMALL * MOST / find_bend(make(SMALL)));
}

TEST(Balance, NoRayLeavesARoomOfBentFaces) {
  std::ptrdiff_t bent = 0;
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Room room = make_bent_room(seed);
    const renderer::Scene blockers = make_mesh(room, {}).blockers;
    bent += std::ranges::count(blockers.polygons, renderer::Shape::bent, &renderer::Polygon::shape);
    renderer::test::Random random{seed};
    expect_closed(room, blockers, random);
  }
  EXPECT_GT(bent, 10);
}

// The part of the ceiling behind the lamp must neither receive nor send light.
TEST(Balance, ALampInThePlaneOfTheCeilingCoversIt) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Room room = make_lamp_room(seed, 0, 6);
    EXPECT_TRUE(is_closed(make_mesh(room, {})));
    EXPECT_NEAR(light(room).escaped, 0, 0.01);
    std::swap(room.faces[1], room.faces.back());
    EXPECT_NEAR(light(room).escaped, 0, 0.01) << "the lamp is listed first";
  }
}

// Through a gap of 1 cm, almost no light reaches the lamp's back. The large patches of the ceiling
// must therefore end at the lamp's shadow.
TEST(Balance, ALampCloseToACoarseCeilingShadesIt) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed)
    for (const int patches : {2, 4}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << patches << " patches");
      const Balance balance = light(make_lamp_room(seed, 0.01, patches));
      EXPECT_LT(balance.backs, 0.01);
      EXPECT_NEAR(balance.escaped, balance.backs, 0.03);
    }
}

}  // namespace
}  // namespace radiosity::test
