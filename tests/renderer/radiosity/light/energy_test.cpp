// Tests the energy balance of a shot, in which one patch sends its light. A few points represent
// each receiving patch, so that there is an error. Simpson's rule is more accurate than the mean of
// the corners. Refinement improves both.

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

// Performs one shot. Returns the power that patches reflect as a result.
Rgb shoot(const Mesh& mesh, const Shot& shot, Mean mean, State& state, Work& work) {
  const FactorParams factor;
  const Eye eye{mesh, factor};
  const auto vertices = all_vertices(mesh), patches = all_patches(mesh);
  const Sender sender(mesh.patches[shot.patch], shot.glow);
  receive(eye, sender, vertices, state, work);
  receive_in_centres(eye, sender, patches, state, work);
  Rgb before, after;
  state.unshot[shot.patch] = {};
  for (const auto p : patches) before += mesh.patches[p].area * state.unshot[p];
  settle(mesh, shot, patches, mean, state, work);
  for (const auto p : patches) after += mesh.patches[p].area * state.unshot[p];
  return after + -1.0 * before;
}

// The fraction of a shot's power that the receiving patches reflect and absorb.
struct Balance {
  double least = 1e9, most = 0, mean = 0;
};
Balance shoot_each(const Mesh& mesh, std::size_t step, Mean mean) {
  Balance balance;
  int shots = 0;
  for (std::uint32_t i = 0; i < mesh.patches.size(); i += step, ++shots) {
    State state = make_state(mesh, Sends::mean);
    for (Rgb& unshot : state.unshot) unshot = {};
    Work work;
    const double area = mesh.patches[i].area;
    const double reflected = shoot(mesh, {i, Glow(grey(1)), 3 * area}, mean, state, work).r;
    const double share = reflected / mesh.materials[0].reflectance.r / area;
    balance.least = std::min(balance.least, share);
    balance.most = std::max(balance.most, share);
    balance.mean += share;
  }
  balance.mean /= shots;
  return balance;
}

Room make_bare_room() {
  Room room;
  room.materials = {{"wall", grey(0.5), grey(1)}};
  add_box(room, 0, {0, 0, 0}, {3, 2, 1.5}, 1);
  return room;
}

// If the mean light of a patch is the mean of its corners, the energy of a single shot near an edge
// of the room does not balance, however fine the mesh is. On the other side of the edge, there are
// always patches whose distance is about their width.
TEST(Energy, OfAShotIsReflectedOrAbsorbed) {
  for (const auto mean : {Mean::corners, Mean::simpson}) {
    std::vector<double> errors;
    for (const int n : {1, 2, 4, 8}) {
      const Mesh mesh = make_mesh(make_bare_room(), {.refine = n});
      const Balance balance = shoot_each(mesh, n < 8 ? 1 : 5, mean);
      errors.push_back(std::abs(balance.mean - 1));
      fmt::print("{}, refine {}: {:.4f} in the mean, {:.4f} to {:.4f}\n",
                 mean == Mean::corners ? "corners" : "simpson", n, balance.mean, balance.least,
                 balance.most);
      const double bound = mean == Mean::corners ? 0.35 : 0.1;
      EXPECT_GT(balance.least, 1 - bound);
      EXPECT_LT(balance.most, 1 + bound);
    }
    EXPECT_LT(errors.back(), 0.01);
  }
}

// With inset 0, vertices are lit exactly in the edges of the room, where they see nothing of the
// wall that they touch.
TEST(Energy, IsLostIfVerticesAreLitInTheEdges) {
  const Mesh mesh = make_mesh(make_bare_room(), {.refine = 4, .inset = 0});
  EXPECT_LT(shoot_each(mesh, 1, Mean::corners).mean, 0.8);
}

// In the end, all emitted light is either absorbed or still unsent.
TEST(Energy, EmittedIsAbsorbed) {
  for (const int n : {1, 2, 4}) {
    Random random{7};
    Room room = make_furnished(random, 2, n);
    room.materials.push_back({"lamp", grey(0.1), grey(10)});
    room.materials[0] = {"wall", grey(0.5), {}};
    room.faces[1].material = 1;
    room.materials[1].reflectance = grey(0.5);
    const Mesh mesh = make_mesh(room, {});
    State state = make_state(mesh, Sends::mean);
    Work work;
    const auto patches = all_patches(mesh);
    double absorbed = 0;
    while (eval_share(sum_unshot(mesh, state, patches)) > 0.01)
      absorbed += shoot(mesh, *find_shot(mesh, state, patches, work), Mean::simpson, state, work).g;
    const double unsent = eval_share(sum_unshot(mesh, state, patches));
    const double share = absorbed / mesh.emitted.g + unsent;
    fmt::print("{} x {}: absorbed {:.4f} of the power emitted\n", n, n, share);
    EXPECT_NEAR(share, 1, n < 4 ? 0.05 : 0.015);
  }
}

}  // namespace
}  // namespace radiosity::test
