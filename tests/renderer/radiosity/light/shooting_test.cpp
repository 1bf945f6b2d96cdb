// Compares shooting with gathering. Also tests the ambient term, and the parts of solve()
// separately.

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/renderer/radiosity/light/gather.hpp"

namespace radiosity::test {
namespace {

// A furnished room with several colours and a lamp in the ceiling. With `mirror`, it has a hanging
// mirror.
Room make_room(std::uint64_t seed, bool mirror, int n) {
  Random random{seed};
  Room room = make_furnished(random, 2, n);
  const auto reflectance = [&] {
    const double r = random.range(0.1, 0.8), g = random.range(0.1, 0.8);
    return Rgb{r, g, random.range(0.1, 0.8)};
  };
  room.materials = {{"wall", reflectance(), {}},
                    {"other", reflectance(), {0.1, 0, 0.2}},
                    {"lamp", reflectance(), {8, 9, 7}},
                    {"mirror", {0.9, 0.8, 1}, {}, true}};
  for (std::size_t i = 6; i < room.faces.size(); ++i) room.faces[i].material = 1;
  room.faces[1].material = 2;
  if (mirror) add_quad(room, 3, {0.1, 0.1, 0.8}, {0.8, 0, 0.1}, {0, 0.2, 0.9}).two_sided = true;
  return room;
}

double sum(const Rgb& c) { return c.r + c.g + c.b; }

TEST(Shooting, AgreesWithGathering) {
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Mesh mesh = make_mesh(make_room(seed, seed % 2 == 0, 1), {});
    const FactorParams factor{.spread = 0.4};
    SolveParams params = make_params(2e-4, factor);
    params.mean = seed % 3 == 0 ? Mean::corners : Mean::simpson;
    params.sends = seed < 3 ? Sends::mean : Sends::corners;
    const Solution shot = solve(mesh, params);
    const Solution gathered = gather(mesh, params, 1e-5);
    double worst = 0;
    for (std::size_t v = 0; v < mesh.vertices.size(); ++v) {
      const Rgb &a = shot.vertices[v], &b = gathered.vertices[v];
      EXPECT_GT(b.r, 0);
      for (const auto& [one, other] : {std::pair{a.r, b.r}, {a.g, b.g}, {a.b, b.b}})
        worst = std::max(worst, std::abs(one / other - 1));
    }
    EXPECT_LT(worst, 0.01);
    fmt::print("{} vertices: {:.5f}\n", mesh.vertices.size(), worst);
  }
}

// The mean radiosity of all patches, weighted by area and averaged over the colours.
double eval_mean_radiosity(const Mesh& mesh, const std::vector<Rgb>& vertices) {
  double total = 0;
  for (const Patch& patch : mesh.patches)
    for (const auto v : patch.corners) total += patch.area / 4 * sum(vertices[v]);
  return total / mesh.area;
}

// Without the ambient term, the unsent light is missing. With it, the mean radiosity must be nearer
// to its final value after any number of shots, and within 5 % of it.
TEST(Shooting, AmbientLightStandsForWhatIsUnsent) {
  const Mesh mesh = make_mesh(make_room(5, false, 2), {});
  const auto mean_after = [&](int shots, bool ambient) {
    SolveParams params = make_params(1e-4);
    params.shots = shots;
    Solution solution = solve(mesh, params);
    if (ambient) add_ambient(mesh, solution.ambient, solution.vertices);
    return eval_mean_radiosity(mesh, solution.vertices);
  };
  const double end = mean_after(1'000'000, false);
  for (const int shots : {0, 1, 2, 4, 8, 16, 32, 64}) {
    SCOPED_TRACE(testing::Message() << shots << " shots");
    const double bare = mean_after(shots, false), lit = mean_after(shots, true);
    fmt::print("{} shots: {:.4f}, with ambient light {:.4f}\n", shots, bare / end, lit / end);
    EXPECT_LT(bare, end);
    EXPECT_GT(lit, bare);
    EXPECT_LT(std::abs(lit - end), std::abs(bare - end));
    EXPECT_NEAR(lit, end, 0.05 * end);
  }
}

TEST(Shooting, SumsOfUnsentLightDoNotDependOnTheOrder) {
  const Mesh mesh = make_mesh(make_room(6, false, 2), {});
  State state = make_state(mesh, Sends::mean);
  Random random{6};
  for (Rgb& unshot : state.unshot) unshot = random.colour();
  auto patches = all_patches(mesh);
  const Unshot expected = sum_unshot(mesh, state, patches);
  for (int k = 0; k < 20; ++k) {
    for (std::size_t i = patches.size(); i > 1; --i)
      std::swap(patches[i - 1],
                patches[static_cast<std::size_t>(random.below(static_cast<int>(i)))]);
    const auto half = std::span(patches).first(patches.size() / 2);
    Unshot parts = sum_unshot(mesh, state, std::span(patches).subspan(half.size()));
    parts += sum_unshot(mesh, state, half);
    EXPECT_EQ(parts, expected);
  }
  EXPECT_NEAR(eval_share(sum_unshot(mesh, make_state(mesh, Sends::mean), patches)), 1, 1e-9);
}

TEST(Shooting, EndsAtItsToleranceOrNumberOfShots) {
  const Mesh mesh = make_mesh(make_room(7, true, 1), {});
  for (const double tolerance : {0.5, 0.1, 0.02}) {
    std::vector<double> unsent;
    const Solution solution = solve(mesh, make_params(tolerance), [&](int shots, double unshot) {
      EXPECT_EQ(static_cast<std::size_t>(shots), unsent.size());
      unsent.push_back(unshot);
      return true;
    });
    EXPECT_LE(solution.unshot, tolerance);
    EXPECT_EQ(static_cast<std::size_t>(solution.shots) + 1, unsent.size());
    unsent.pop_back();
    for (const double unshot : unsent) EXPECT_GT(unshot, tolerance);
  }
  SolveParams params = make_params(0);
  params.shots = 7;
  const Solution seven = solve(mesh, params), again = solve(mesh, params);
  EXPECT_EQ(seven.shots, 7);
  EXPECT_EQ(seven.vertices, again.vertices);
  EXPECT_EQ(seven.work, again.work);
  EXPECT_EQ(solve(mesh, make_params(0), [](int shots, double) { return shots < 3; }).shots, 3);
}

TEST(Shooting, GoesOnAsIfItHadNotBeenLeft) {
  const Mesh mesh = make_mesh(make_room(7, true, 1), {});
  const Solution whole = solve(mesh, make_params(0.02));
  const Solution halves = solve_further(mesh, make_params(0.02), solve(mesh, make_params(0.3)));
  EXPECT_EQ(halves.vertices, whole.vertices);
  EXPECT_EQ(halves.means, whole.means);
  EXPECT_EQ(halves.shots, whole.shots);
  EXPECT_EQ(halves.unshot, whole.unshot);
  EXPECT_EQ(halves.ambient, whole.ambient);
  EXPECT_EQ(halves.work, whole.work);
}

// The patch with the most unsent light shoots first. If several patches have equal unsent light,
// the first of them shoots. After its shot, a patch has no unsent light except light that mirrors
// return.
TEST(Shooting, TheBrightestShoots) {
  const Mesh mesh = make_mesh(make_room(8, false, 2), {});
  State state = make_state(mesh, Sends::mean);
  Work work;
  const auto patches = all_patches(mesh);
  const auto shot = find_shot(mesh, state, patches, work);
  ASSERT_TRUE(shot);
  for (const auto p : patches) {
    const double power = sum(state.unshot[p]) * mesh.patches[p].area;
    EXPECT_TRUE(power < shot->power || (power == shot->power && p >= shot->patch));
  }
  receive({mesh, {}}, {mesh.patches[shot->patch], shot->glow}, all_vertices(mesh), state, work);
  settle(mesh, *shot, patches, Mean::corners, state, work);
  EXPECT_EQ(state.unshot[shot->patch], Rgb{});
  for (Rgb& unshot : state.unshot) unshot = {};
  EXPECT_FALSE(find_shot(mesh, state, patches, work));
}

// The mean is over all colours, with patches weighted by area. Materials that only one of the
// meshes has are omitted.
TEST(MeanRadiosity, IsOfAllColoursByArea) {
  LitRoom lit{make_mesh(make_room(3, false, 2), {}), {}};
  const auto is_wall = [&](const Patch& patch) {
    return lit.mesh.materials[patch.material].name == "wall";
  };
  lit.vertices.assign(lit.mesh.vertices.size(), {1, 2, 6});
  EXPECT_NEAR(radiosity::eval_mean_radiosity(lit, lit.mesh), 3, 1e-12);
  double other_sum = 0, area = 0;
  for (const Patch& patch : lit.mesh.patches) {
    if (is_wall(patch)) continue;
    for (const auto corner : patch.corners) lit.vertices[corner] = {3, 4, 5};
  }
  Mesh others = lit.mesh;
  std::erase_if(others.patches, is_wall);
  for (const Patch& patch : others.patches) {
    other_sum += 4 * patch.area;
    area += patch.area;
  }
  EXPECT_NEAR(radiosity::eval_mean_radiosity(lit, others), other_sum / area, 1e-12);
  EXPECT_LT(radiosity::eval_mean_radiosity(lit, lit.mesh), 4);
}

}  // namespace
}  // namespace radiosity::test
