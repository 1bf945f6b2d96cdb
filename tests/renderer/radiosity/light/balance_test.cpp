// The energy balance of a room, and rooms that lose no light.

#include "renderer/radiosity/light/balance.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

// A grey box in which one patch, flush with the ceiling, emits.
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

// A wall inside a room does not open it. Light on its back is reported separately from lost light.
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

// Rooms have hanging lamps and standing blocks. Only a hole in the shell opens a room.
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

}  // namespace
}  // namespace radiosity::test
