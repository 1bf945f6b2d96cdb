// Tests the light where a face stands near the border of another face (on a ledge), and on the
// floor under a hanging edge.

#include <gtest/gtest.h>

#include "renderer/radiosity/mesh/contacts.hpp"
#include "tests/renderer/radiosity/support.hpp"

namespace radiosity::test {
namespace {

constexpr double LONG = 60, HEIGHT = 1;

// A face that is one patch high, and stands on a bright face that extends by `width` in front of
// it.
Room make_room(double width) {
  Room room;
  room.materials = {{"face", grey(0.5), {}}, {"ledge", grey(0), grey(1)}};
  add_quad(room, 1, {0, -width, 0}, {LONG, 0, 0}, {0, width + 2, 0});
  add_quad(room, 0, {1, 0, 0}, {LONG - 2, 0, 0}, {0, 0, HEIGHT}, 20, 1);
  return room;
}

// The form factor from a vertex to the bright face.
double eval_share(const Mesh& mesh, const Vertex& vertex) {
  return sum_factors({mesh, {}}, vertex, [](const Patch& patch) { return patch.material == 1; });
}

TEST(Ledges, AreFoundWithTheirWidths) {
  for (const double width : {0.01, 0.5, 4.0}) {
    const auto contacts = find_contacts(make_room(width), 1);
    EXPECT_TRUE(contacts[0].ledges.empty());
    ASSERT_EQ(contacts[1].ledges.size(), 1u);
    const Ledge& ledge = contacts[1].ledges[0];
    EXPECT_NEAR(length(ledge.foot.b - ledge.foot.a), LONG - 2, 1e-3);
    for (const double x : {1.0, 20.0, LONG - 1})
      EXPECT_NEAR(eval_width(ledge, {x, 0, 0}), width, 1e-9);
  }
  // A wall at which the floor ends does not stand on this floor: there is no ledge.
  Room box;
  box.materials = {{"wall", grey(0.5), grey(1)}};
  add_box(box, 0, {0, 0, 0}, {3, 2, 1});
  for (const auto& contacts : find_contacts(box, 1)) EXPECT_TRUE(contacts.ledges.empty());
}

// The ledge in front of a standing face may continue in another face.
TEST(Ledges, EndWhereTheSurfaceDoes) {
  Room room = make_room(0.2);
  add_quad(room, 1, {0, -5, 0}, {LONG, 0, 0}, {0, 4.8, 0});
  const auto contacts = find_contacts(room, 1);
  ASSERT_EQ(contacts[1].ledges.size(), 1u);
  EXPECT_EQ(eval_width(contacts[1].ledges[0], {20, 0, 0}), INFINITY);
  Room under = make_room(0.2);
  under.faces[0] = turn(under.faces[0]);
  EXPECT_TRUE(find_contacts(under, 1)[1].ledges.empty());
}

// The ledge may narrow: the angle between its edge and the foot is arbitrary, and they may even
// meet. The room is rotated by any angle.
TEST(Ledges, MayNarrowToAPoint) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const double width = random.range(0, 0.4), angle = random.range(0, 7);
    Room room = make_room(0);
    room.faces.resize(1);
    add_quad(room, 0, {1, width, 0}, {10, -width, 0}, {0, 0, HEIGHT}, 10, 1);
    for (Face& face : room.faces)
      for (Vec& p : face.corners)
        p = {std::cos(angle) * p.x - std::sin(angle) * p.y,
             std::sin(angle) * p.x + std::cos(angle) * p.y, p.z};
    for (const Vertex& vertex : make_mesh(room, {}).vertices) {
      const double moved = length(vertex.lit - vertex.at);
      // the displacement must be finite
      EXPECT_LT(moved, 0.4) << vertex.at.x << ' ' << vertex.at.y;
    }
  }
}

// Beside a ledge, the light of a vertex at the foot is computed at the height that makes the mean
// of the patch right. For a ledge wider than four times the patch's height, this is at the foot
// itself. (The mean is not tested for such ledges, because a single patch as ledge is too near for
// an accurate form factor.)
TEST(Ledges, GiveAPatchItsMeanLight) {
  for (const double width : {0.03, 0.1, 0.25, 0.5, 0.9, 1.1, 3.0, 5.0}) {
    SCOPED_TRACE(testing::Message() << "width " << width);
    const Mesh mesh = make_mesh(make_room(width), {});
    const auto patch = std::ranges::find_if(mesh.patches, [](const Patch& p) {
      return p.face == 1 && std::abs(p.centre.x - LONG / 2) < 2;
    });
    ASSERT_NE(patch, mesh.patches.end());
    double mean = 0;
    for (const auto corner : patch->corners) {
      const Vertex& vertex = mesh.vertices[corner];
      mean += eval_share(mesh, vertex) / 4;
      if (width > 4 * HEIGHT) {
        EXPECT_LT(vertex.lit.z - vertex.at.z, 0.01);
      }
    }
    const double expected = (1 - std::hypot(1, width) + width) / 2;
    if (width <= 4 * HEIGHT) {
      EXPECT_NEAR(mean, expected, 0.02 * expected);
    }
  }
}

// An object hangs just above a floor; it is level, or slopes along its edge. Light enters under the
// object. In the patches beside its edge, the mean of this light must be right.
TEST(Hanging, GivesPatchesBesideItsEdgeTheirMeanLight) {
  const auto check = [](double gap, double slope) {
    SCOPED_TRACE(testing::Message() << "gap " << gap << ", slope " << slope);
    Room room;
    room.materials = {{"floor", grey(0.5), {}}, {"sky", grey(0), grey(1)}};
    add_quad(room, 0, {0, 0, 0}, {LONG, 0, 0}, {0, 12, 0}, 60, 12);
    add_quad(room, 0, {0, 6, gap - slope * LONG / 2}, {0, 6, 0}, {LONG, 0, slope * LONG});
    // a wall so large that it covers half of the sky
    add_quad(room, 1, {2000, -40, 0}, {-4000, 0, 0}, {0, 0, 2000});
    const Mesh mesh = make_mesh(room, {});
    double worst = 0;
    for (const Patch& patch : mesh.patches) {
      if (patch.face != 0 || std::abs(patch.centre.x - LONG / 2) > 1) continue;
      double mean = 0, from = INFINITY, to = -INFINITY;
      for (std::size_t i = 0; i < 4; ++i) {
        mean += eval_share(mesh, mesh.vertices[patch.corners[i]]) / 4;
        from = std::min(from, patch.at[i].y - 6);
        to = std::max(to, patch.at[i].y - 6);
      }
      if (from > -1e-6 && to < 3) {
        // At the distance y from the edge, below the object, the fraction (1 - y / sqrt(y^2 +
        // gap^2)) / 2 of the light of half the sky arrives. The mean is its integral from `from` to
        // `to`, divided by their distance.
        const double expected =
            (1 - (std::hypot(to, gap) - std::hypot(from, gap)) / (to - from)) / 2;
        worst = std::max(worst, std::abs(mean - expected));
      }
    }
    std::printf("gap %.3f: a patch's light is off by %.4f at most\n", gap, worst);
    EXPECT_LT(worst, slope > 0 ? 0.05 : 0.03);
  };
  for (const double gap : {0.001, 0.01, 0.1, 0.3, 0.49, 0.9}) check(gap, 0);
  check(0.24, 0.007);
}

}  // namespace
}  // namespace radiosity::test
