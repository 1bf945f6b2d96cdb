// Where the light of a shot goes. The mean of a patch's corners stands for the patch, so that the
// books balance within the error of that, which falls with refinement.

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

// What the receivers got of a shot, by its power: reflected and kept to be sent, or absorbed.
struct Balance {
  double least = 1e9, most = 0, mean = 0;
};
Balance shoot_each(const Mesh& mesh, std::size_t step) {
  Balance balance;
  const Eye eye{mesh, {}};
  const auto vertices = all_vertices(mesh), patches = all_patches(mesh);
  const Material& wall = mesh.materials[0];
  int shots = 0;
  for (std::uint32_t i = 0; i < mesh.patches.size(); i += step, ++shots) {
    State state = make_state(mesh);
    for (Rgb& unshot : state.unshot) unshot = {};
    Work work;
    receive(eye, {i, grey(1), 3 * mesh.patches[i].area}, vertices, state, work);
    settle(mesh, {i, grey(1), 3 * mesh.patches[i].area}, patches, state, work);
    double reflected = 0;
    for (const auto p : patches) reflected += mesh.patches[p].area * state.unshot[p].r;
    const double share = reflected / wall.reflectance.r / mesh.patches[i].area;
    balance.least = std::min(balance.least, share);
    balance.most = std::max(balance.most, share);
    balance.mean += share;
  }
  balance.mean /= shots;
  return balance;
}

// All shots together balance within 0.5 % at 8 x 8 patches a wall. One alone, near an edge of the
// room, does not at any refinement: the patches across the edge are as near to it as they are wide.
TEST(Energy, OfAShotIsReflectedOrAbsorbed) {
  Room room;
  room.materials = {{"wall", grey(0.5), grey(1)}};
  add_box(room, 0, {0, 0, 0}, {3, 2, 1.5}, 1);
  std::vector<double> errors;
  for (const int n : {1, 2, 4, 8}) {
    const Balance balance = shoot_each(make_mesh(room, {.refine = n}), n < 8 ? 1 : 5);
    errors.push_back(std::abs(balance.mean - 1));
    fmt::print("refine {}: {:.4f} in the mean, {:.4f} to {:.4f}\n", n, balance.mean, balance.least,
               balance.most);
    EXPECT_GT(balance.least, 0.7);
    EXPECT_LT(balance.most, 1.35);
  }
  for (std::size_t k = 1; k < errors.size(); ++k) EXPECT_LT(errors[k], errors[k - 1] / 2 + 0.003);
  EXPECT_LT(errors.back(), 0.005);
}

// Vertices in the room's edges, not inside of them, see nothing of the wall they touch.
TEST(Energy, IsLostIfVerticesAreLitInTheEdges) {
  Room room;
  room.materials = {{"wall", grey(0.5), grey(1)}};
  add_box(room, 0, {0, 0, 0}, {3, 2, 1.5}, 1);
  EXPECT_LT(shoot_each(make_mesh(room, {.refine = 4, .inset = 0}), 1).mean, 0.8);
}

// All that was emitted ends up absorbed: the sum over patches of (1 - rho) B A, by the state's own
// books, is what was emitted, within the same error.
TEST(Energy, EmittedIsAbsorbed) {
  std::vector<double> errors;
  for (const int n : {1, 2, 4}) {
    Random random{7};
    Room room = make_furnished(random, 2, n);
    room.materials.push_back({"lamp", grey(0.1), grey(10)});
    room.materials[0] = {"wall", {0.7, 0.5, 0.3}, {}};
    room.faces[1].material = 1;
    const Mesh mesh = make_mesh(room, {});
    const Solution solution = solve(mesh, make_params(2e-3));
    double absorbed = 0, emitted = 0;
    for (const Patch& patch : mesh.patches) {
      const Material& material = mesh.materials[patch.material];
      Rgb b;
      for (const auto v : patch.corners) b += 0.25 * solution.vertices[v];
      // What is not reflected of what came in: (B - E) / rho * (1 - rho).
      absorbed += patch.area * (b.g - material.emission.g) * (1 / material.reflectance.g - 1);
      emitted += patch.area * material.emission.g;
    }
    errors.push_back(std::abs(absorbed / emitted - 1));
    fmt::print("{} x {}: absorbed {:.4f} of the power emitted\n", n, n, absorbed / emitted);
  }
  EXPECT_LT(std::max(errors[0], errors[1]), 0.03);
  EXPECT_LT(errors[2], 0.012);
}

}  // namespace
}  // namespace radiosity::test
