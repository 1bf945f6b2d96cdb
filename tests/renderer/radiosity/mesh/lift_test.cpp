// Tests faces that overlap in one plane.

#include "renderer/radiosity/mesh/lift.hpp"

#include <gtest/gtest.h>

#include "renderer/radiosity/mesh/contacts.hpp"
#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

// A room whose ceiling consists of two faces side by side. A lamp of `columns` x `rows` tiles
// extends over both faces.
Room make_tiled_lamp(std::uint64_t seed, int columns, int rows) {
  Random random{seed};
  Room room;
  room.materials = {{"wall", grey(0.7), {}}, {"lamp", grey(0.2), grey(10)}};
  add_box(room, 0, {0, 0, 0}, {4, 3, 2.5}, 4);
  room.faces.erase(room.faces.begin() + 1);
  const Vec lo{0.5 + 0.125 * random.below(16), 0.5 + 0.125 * random.below(8), 2.5};
  const double cut = lo.x + 0.75;
  add_quad(room, 0, {0, 0, 2.5}, {0, 3, 0}, {cut, 0, 0}, 4, 3);
  add_quad(room, 0, {cut, 0, 2.5}, {0, 3, 0}, {4 - cut, 0, 0}, 4, 3);
  const Vec along{1.5 / columns, 0, 0}, across{0, 1.0 / rows, 0};
  for (int i = 0; i < columns; ++i)
    for (int k = 0; k < rows; ++k)
      add_quad(room, 1, lo + i * along + k * across, across, along, 4 / rows, 4 / columns);
  if (random.below(2) == 0) std::ranges::reverse(room.faces);
  return room;
}

// The number of the lamp's vertices on each of the two lines that divide a lamp of four tiles.
std::array<std::size_t, 2> count_on_cuts(const Mesh& mesh) {
  renderer::Bounds lamp;
  for (const Vertex& vertex : mesh.vertices)
    if (vertex.material == 1) lamp = join(lamp, renderer::Bounds{vertex.at, vertex.at});
  const Vec middle = 0.5 * (lamp.lo + lamp.hi);
  std::array<std::size_t, 2> found{};
  for (const Vertex& vertex : mesh.vertices) {
    if (vertex.material != 1) continue;
    found[0] += std::abs(vertex.at.x - middle.x) < 1e-5;
    found[1] += std::abs(vertex.at.y - middle.y) < 1e-5;
  }
  return found;
}

TEST(Lift, ALampInTilesIsOneLamp) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const Mesh whole = make_mesh(make_tiled_lamp(seed, 1, 1), {});
    const double absorbed = solve(whole, {}).balance.absorbed;
    EXPECT_EQ(count_on_cuts(whole), (std::array<std::size_t, 2>{5, 5}));
    for (const int rows : {1, 2}) {
      const Mesh tiled = make_mesh(make_tiled_lamp(seed, 2, rows), {});
      EXPECT_EQ(count_on_cuts(tiled), count_on_cuts(whole)) << rows;
      EXPECT_NEAR(solve(tiled, {}).balance.absorbed, absorbed, 0.005 * absorbed) << rows;
    }
  }
}

// A floor with overlapping rectangles in its plane, some of them two-sided.
Room make_stack(Random& random, int rectangles) {
  Room room;
  room.materials = {{"a", grey(0.5), {}}, {"b", grey(0.5), {}}, {"lamp", {}, grey(1)}};
  const double size = std::pow(10, random.range(-2, 2));
  const Vec n = random.direction(), by = size * random.point(5);
  const auto [u, v] = renderer::test::make_plane(n);
  const auto add = [&](double x, double y, double wide, double high) {
    Face& face = add_quad(room, static_cast<std::uint32_t>(random.below(3)),
                          by + size * (x * u + y * v), size * wide * u, size * high * v);
    face.two_sided = random.below(4) == 0;
    if (random.below(4) == 0) face = turn(face);
  };
  add(0, 0, 1, 1);
  add(1, 0, 1, 1);
  for (int i = 0; i < rectangles; ++i) {
    // Multiples of a quarter, so that some rectangles abut.
    const auto choose = [&](int most) { return 0.25 * random.below(most); };
    const double x = choose(7), y = choose(3);
    add(x, y, 0.25 + choose(4), 0.25 + choose(4));
  }
  return room;
}

TEST(Lift, StacksStayNearTheirPlaneAndInOrder) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Room room = make_stack(random, 1 + random.below(20));
    const auto contacts = find_contacts(room, 1);
    const Vec normal = normalize(eval_area_normal(room.faces[0].corners));
    const auto bounds = eval_bounds(room);
    for (std::size_t i = 0; i < contacts.size(); ++i) {
      const Vec& lift = contacts[i].lift;
      EXPECT_LE(length(lift), 1e-6 * length(bounds.hi - bounds.lo));
      EXPECT_NEAR(length(cross(lift, normal)), 0, 1e-9 * length(lift));
      const Face& face = room.faces[i];
      if (!face.two_sided) {
        EXPECT_GE(dot(lift, eval_area_normal(face.corners)), 0);
      }
    }
  }
}

// Several copies of a square must be above each other, with clear distances, even in a high stack.
TEST(Lift, CopiesOfAFaceAreInOrder) {
  for (const int copies : {1, 2, 9, 10, 100}) {
    Room room;
    room.materials = {{"a", grey(0.5), {}}};
    for (int i = 0; i < copies; ++i) add_quad(room, 0, {2, 1, 3}, {1, 0, 0}, {0, 1, 0});
    const auto contacts = find_contacts(room, 1);
    const double epsilon = make_mesh(room, {}).blockers.epsilon;
    for (std::size_t i = 1; i < contacts.size(); ++i)
      EXPECT_GT(contacts[i].lift.z, contacts[i - 1].lift.z + epsilon) << copies;
    EXPECT_LE(contacts.back().lift.z, 1e-6 * std::sqrt(2) + 1e-15) << copies;
    EXPECT_EQ(contacts.front().lift, Vec{});
  }
}

}  // namespace
}  // namespace radiosity::test
