// The furnace test: if every face emits E and reflects rho, the radiosity B is E / (1 - rho)
// everywhere.

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

void expect_furnace(Room room, double reflectance, const SolveParams& params, double tolerance) {
  room.materials = {{"wall", {reflectance, reflectance / 2, 0}, {1, 2, 0.5}}};
  const Mesh mesh = make_mesh(room, {});
  Solution solution = solve(mesh, params);
  add_ambient(mesh, solution.ambient, solution.vertices);
  EXPECT_LE(solution.unshot, params.tolerance);
  const Rgb expected{1 / (1 - reflectance), 2 / (1 - reflectance / 2), 0.5};
  double worst = 0, total = 0;
  for (const Rgb& b : solution.vertices) {
    worst = std::max({worst, std::abs(b.r / expected.r - 1), std::abs(b.g / expected.g - 1)});
    total += b.r / expected.r / static_cast<double>(solution.vertices.size());
    EXPECT_EQ(b.b, expected.b);
  }
  EXPECT_LT(worst, tolerance);
  EXPECT_NEAR(total, 1, 0.005);
  const double lost = solution.balance.escaped;
  EXPECT_LT(std::abs(lost), 0.005);
  EXPECT_TRUE(is_closed(mesh));
  fmt::print("rho {}: worst {:.4f}, mean {:.4f}, lost {:.4f}\n", reflectance, worst, total - 1,
             lost);
}

// Uses default parameters, and adds the estimate of the unsent light. A relative error of the sum
// of form factors makes B wrong by rho / (1 - rho) times that error. At rho = 0.9, an accuracy of
// 0.5 % in B requires 0.06 % in the sum.
TEST(Furnace, IsAsBrightAsTheFormulaSays) {
  const auto make = [](int n) {
    Room room;
    add_box(room, 0, {0, 0, 0}, {3, 2, 1.5}, n);
    return room;
  };
  for (const double reflectance : {0.2, 0.5, 0.8, 0.9})
    for (const int n : {1, 2, 3}) expect_furnace(make(n), reflectance, {}, 0.005);
}

TEST(Furnace, WithThingsInside) {
  Random random{1};
  const Room room = make_furnished(random, 2, 1);
  expect_furnace(room, 0.3, make_params(1e-3), 0.01);
  expect_furnace(room, 0.5, make_params(1e-3, {.spread = 0.07}), 0.01);
}

}  // namespace
}  // namespace radiosity::test
