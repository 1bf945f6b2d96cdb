// Where the light of a room has gone, and from which rooms none can go.

#include "renderer/radiosity/light/balance.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

// A box of which all sides are grey and one patch in the ceiling, flush with it, shines.
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

// Two walls that are seen from both sides divide a room into closed halves.
TEST(Balance, WhatHasTwoSidesClosesBoth) {
  Room room = make_closed();
  add_quad(room, 0, {1, 0, 0}, {0, 2, 0}, {0, 0, 2}, 2, 2);
  EXPECT_FALSE(is_closed(make_mesh(room, {})));
  room.faces.back().two_sided = true;
  EXPECT_TRUE(is_closed(make_mesh(room, {})));
}

}  // namespace
}  // namespace radiosity::test
