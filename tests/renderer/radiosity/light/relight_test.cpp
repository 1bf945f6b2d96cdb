// Tests the light from the patches of one mesh at the vertices of a finer mesh.
#include "renderer/radiosity/light/solve.hpp"

#include <gtest/gtest.h>

#include "renderer/radiosity/mesh/contacts.hpp"
#include "tests/renderer/radiosity/support.hpp"

namespace radiosity {
namespace {

Room make_lit_room(std::uint64_t seed) {
  test::Random random(seed);
  Room room = test::make_furnished(random, 1, 2);
  room.materials = {{"wall", {0.6, 0.5, 0.4}, {}}, {"lamp", {}, {9, 8, 7}}};
  test::add_quad(room, 1, {1, 1, 1.9}, {0, 0.4, 0}, {0.4, 0, 0}, 2, 2);
  return room;
}

TEST(Relight, OfTheSameMeshIsSolve) {
  const auto mesh = make_mesh(make_lit_room(1), {});
  const auto params = test::make_params(0.05);
  const auto solved = solve(mesh, params), again = solve(mesh, params, {}, &mesh);
  EXPECT_EQ(again.vertices, solved.vertices);
  EXPECT_EQ(again.ambient, solved.ambient);
  EXPECT_EQ(again.shots, solved.shots);
}

// A vertex that both meshes have, lit at the same position, must receive the same light.
TEST(Relight, VerticesOfBothMeshesAgree) {
  MeshParams fine;
  fine.refine = 3;
  fine.inset = 0;
  MeshParams coarse;
  coarse.inset = 0;
  for (const std::uint64_t seed : {1, 2, 3}) {
    const auto room = make_lit_room(seed);
    const auto one = make_mesh(room, coarse), three = make_mesh(room, fine);
    const std::array contacts{find_contacts(room, coarse.refine), find_contacts(room, fine.refine)};
    const auto params = test::make_params(0.1);
    const auto solved = solve(one, params), lit = solve(one, params, {}, &three);
    std::size_t missing = 0;
    for (std::size_t i = 0; i < one.vertices.size(); ++i) {
      // Strips beside objects that hang over a face depend on the width of the face's patches.
      bool found = std::ranges::any_of(contacts, [&](const std::vector<Contacts>& some) {
        return !some[one.vertices[i].object].folds.empty();
      });
      for (std::size_t j = 0; j < three.vertices.size(); ++j) {
        const Vertex &a = one.vertices[i], &b = three.vertices[j];
        if (length(a.at - b.at) > 1e-9 || length(a.normal - b.normal) > 1e-9) continue;
        found = true;
        EXPECT_NEAR(lit.vertices[j].r, solved.vertices[i].r, 1e-6 + 1e-3 * solved.vertices[i].r)
            << "seed " << seed;
      }
      missing += !found;
    }
    EXPECT_EQ(missing, 0u);
  }
}

}  // namespace
}  // namespace radiosity
