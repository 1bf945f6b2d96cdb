// Tests objects that touch a face or hang just above it, and the light on the face there.

#include "renderer/radiosity/mesh/contacts.hpp"

#include <gtest/gtest.h>

#include "renderer/radiosity/creases/creases.hpp"
#include "renderer/radiosity/light/solve.hpp"
#include "tests/renderer/radiosity/blocks.hpp"

namespace radiosity::test {
namespace {

TEST(Contacts, FeetLeaningAndStacked) {
  Room room;
  room.materials = {{"wall", grey(0.5), grey(1)}};
  add_box(room, 0, {0, 0, 0}, {4, 4, 4});
  EXPECT_EQ(
      std::ranges::count_if(find_contacts(room, 1), [](const auto& c) { return !c.lines.empty(); }),
      0);
  // The left side of the block lies in the wall, and its bottom lies in the floor.
  add_block(room, 0, {0, 1, 0}, {1, 2, 1});
  auto contacts = find_contacts(room, 1);
  EXPECT_EQ(contacts[0].lines.size(), 6u);  // feet of three sides, and three edges of the bottom
  EXPECT_EQ(contacts[1].lines.size(), 0u);
  EXPECT_EQ(contacts[2].lines.size(), 6u);
  for (std::size_t f = 6; f < room.faces.size(); ++f) EXPECT_TRUE(contacts[f].lines.empty()) << f;
  // A block divides the top of the block on which it stands. A face through a wall divides the
  // wall.
  room.faces.resize(6);
  add_block(room, 0, {1, 1, 0}, {2, 2, 1});
  add_block(room, 0, {1.25, 1.25, 1}, {1.75, 1.75, 2});
  contacts = find_contacts(room, 1);
  EXPECT_EQ(contacts[0].lines.size(), 8u);
  add_quad(room, 0, {-1, 3, 1}, {2, 0, 0}, {0, 0, 1});
  EXPECT_EQ(find_contacts(room, 1)[2].lines.size(), 1u);
}

// A floor with patches one unit wide, for tests of objects just above it.
Room make_floor() {
  Room room;
  room.materials = {{"wall", grey(0.5), grey(0)}, {"lamp", grey(0), grey(1)}};
  add_quad(room, 0, {0, 0, 0}, {8, 0, 0}, {0, 8, 0}, 8, 8);
  return room;
}

TEST(Contacts, WhatHangsAboveMakesFoldsAndStrips) {
  const auto count = [](const Block& block, int refine) {
    Room room = make_floor();
    add_block(room, block, true, 1, 1);
    const Contacts contacts = find_contacts(room, refine)[0];
    for (const auto& [below, inward, above] : contacts.hanging) {
      EXPECT_NEAR(std::abs(eval_height(above, below.a)), block.low, 1e-9);
      EXPECT_NEAR(length(inward), 1, 1e-9);
      EXPECT_NEAR(dot(inward, below.b - below.a), 0, 1e-9);
    }
    EXPECT_EQ(contacts.lines.size(), contacts.hanging.size());
    for (const Crease& fold : contacts.folds) EXPECT_NEAR(fold.a.z, 0, 1e-12);
    // Beside each fold, strips end at 0.5, 1, 2, ... times the edge's height.
    for (const Crease& strip : contacts.strips) {
      double nearest = 1e300;
      for (const Crease& fold : contacts.folds)
        if (length(cross(normalize(strip.b - strip.a), normalize(fold.b - fold.a))) < 1e-6)
          nearest = std::min(nearest, length(cross(strip.a - fold.a, normalize(fold.b - fold.a))));
      const double doublings = std::log2(nearest / block.low);
      EXPECT_NEAR(doublings, std::round(doublings), 1e-6);
      EXPECT_GT(doublings, -1.001);
      EXPECT_LE(nearest, 0.6 / refine + 1e-9);
    }
    return std::array{contacts.hanging.size(), contacts.folds.size(), contacts.strips.size()};
  };
  using Counts = std::array<std::size_t, 3>;
  const auto block = [](double gap, double half) {
    return Block{4.2, 4.1, gap, gap + 1, half, half, 0.3};
  };
  EXPECT_EQ(count(block(0.009, 1.5), 1), (Counts{4, 0, 0})) << "touches";
  EXPECT_EQ(count(block(0.02, 1.5), 1), (Counts{0, 4, 48})) << "at 0.01, 0.02, ... 0.32";
  EXPECT_EQ(count(block(0.49, 1.5), 1), (Counts{0, 4, 16}));
  EXPECT_EQ(count(block(0.9, 1.5), 1), (Counts{0, 4, 8}));
  EXPECT_EQ(count(block(1.01, 1.5), 1), (Counts{0, 0, 0})) << "a penumbra that patches can show";
  EXPECT_EQ(count(block(0.51, 1.5), 2), (Counts{0, 0, 0})) << "likewise";
  EXPECT_EQ(count(block(0.24, 1.5), 2), (Counts{0, 4, 16}));
  EXPECT_EQ(count(block(0.1, 0.4), 1), (Counts{0, 0, 0})) << "narrower than a patch";
  EXPECT_EQ(count({4.2, 4.1, 0.1, 1, 3, 0.05, 0.3}, 1), (Counts{0, 0, 0})) << "likewise";
}

TEST(Contacts, WithoutStripsWhatHangsWithinHalfAPatchTouches) {
  for (const double gap : {0.1, 0.49, 0.51, 0.9}) {
    Room room = make_floor();
    add_block(room, {4.2, 4.1, gap, 2, 1.5, 1.5, 0.3}, true, 1, 1);
    const Contacts contacts = find_contacts(room, 1, 3)[0];
    EXPECT_EQ(contacts.strips.size(), 0u);
    EXPECT_EQ(contacts.hanging.size(), gap < 0.5 ? 4u : 0u) << gap;
    EXPECT_EQ(contacts.folds.size(), gap < 0.5 ? 0u : 4u) << gap;
  }
}

// A low block on the floor touches the floor only with the feet of its sides. An object close above
// the floor touches it along the outline of its underside, even if the underside has two parts. An
// object behind a face touches the face only if it is two-sided.
TEST(Contacts, OnlyOpenEdgesOfWhatHangsCount) {
  Room low = make_floor();
  add_block(low, {4.2, 4.1, 0, 0.1, 1.5, 1.5, 0.3}, false, 1, 1);
  EXPECT_EQ(find_contacts(low, 1)[0].lines.size(), 4u);
  EXPECT_EQ(find_contacts(low, 1)[0].folds.size(), 0u);

  Room two = make_floor();
  add_quad(two, 0, {2, 2, 0.1}, {0, 3, 0}, {1.5, 0, 0}, 1, 1);
  add_quad(two, 0, {3.5, 2, 0.1}, {0, 3, 0}, {1.5, 0, 0}, 1, 1);
  EXPECT_EQ(find_contacts(two, 1)[0].folds.size(), 6u);
  two.faces[1].corners = {{2, 2, 0.1}, {2, 5, 0.1}, {4.9, 5, 0.1}, {4.9, 2, 0.1}};
  two.faces[2].corners = {{4.9, 2, 0.1}, {4.9, 5, 0.1}, {5.1, 5, 0.1}, {5.1, 2, 0.1}};
  EXPECT_EQ(find_contacts(two, 1)[0].folds.size(), 3u) << "one is narrower than a patch";

  Room sheet = make_floor();  // a sheet with a front and a back, close to the floor
  add_quad(sheet, 0, {2, 2, 0.1}, {0, 3, 0}, {3, 0, 0}, 1, 1);
  add_quad(sheet, 0, {2, 2, 0.1}, {3, 0, 0}, {0, 3, 0}, 1, 1);
  EXPECT_EQ(find_contacts(sheet, 1)[0].folds.size(), 8u);

  Room plate = make_floor();
  add_block(plate, {4.2, 4.1, 0.01, 0.05, 1.5, 1.5, 0.3}, true, 1, 1);
  EXPECT_EQ(find_contacts(plate, 1)[0].folds.size(), 4u);

  Room leg = make_floor();  // a prism with many sides, a fifth of a patch wide
  Face bottom = leg.faces[0];
  bottom.corners.clear();
  for (int i = 0; i < 32; ++i) {
    const double angle = -2 * std::numbers::pi * i / 32;
    bottom.corners.push_back({4.2 + 0.1 * std::cos(angle), 4.1 + 0.1 * std::sin(angle), 0.1});
  }
  leg.faces.push_back(bottom);
  EXPECT_EQ(find_contacts(leg, 1)[0].lines.size(), 0u);

  // Tests lids (hanging polygons) with 3 and with 32 corners.
  for (const int corners : {3, 32}) {
    Room lid = make_floor();
    Face face = lid.faces[0];
    face.corners.clear();
    for (int i = 0; i < corners; ++i) {
      const double angle = -2 * std::numbers::pi * i / corners;
      face.corners.push_back({4.2 + 2 * std::cos(angle), 4.1 + 2 * std::sin(angle), 0.1});
    }
    lid.faces.push_back(face);
    const auto contacts = find_contacts(lid, 1);
    EXPECT_EQ(contacts[0].lines.size(), 0u);
    EXPECT_EQ(contacts[0].folds.size(), static_cast<std::size_t>(corners));
  }

  Room behind = make_floor();
  add_quad(behind, 0, {2, 2, -0.1}, {0, 3, 0}, {3, 0, 0}, 1, 1);
  EXPECT_EQ(find_contacts(behind, 1)[0].lines.size(), 0u);
  behind.faces[0].two_sided = true;
  EXPECT_EQ(find_contacts(behind, 1)[0].folds.size(), 4u);
}

// A cylinder of narrow facets that lies on the floor touches it only along one line.
TEST(Contacts, FacetsAboveTheFloorHaveNone) {
  constexpr int FACETS = 32;
  constexpr double RADIUS = 0.5;
  Room room = make_floor();
  const auto rim = [](int i) {
    const double angle = 2 * std::numbers::pi * (i + 0.5) / FACETS;
    return Vec{4.2 + RADIUS * std::sin(angle), 2, RADIUS * (1 - std::cos(angle)) - 0.003};
  };
  for (int i = 0; i < FACETS; ++i) add_quad(room, 0, rim(i), rim(i + 1) - rim(i), {0, 4, 0}, 1, 4);
  EXPECT_EQ(find_contacts(room, 1)[0].lines.size(), 2u);
}

// Neither too little nor too much light passes through the gap under a block that hangs above the
// floor. The light at the corners of a patch must agree with the light in its middle.
TEST(Contacts, LightUnderWhatHangsIsFollowed) {
  for (const double gap : {0.004, 0.02, 0.1, 0.3, 0.7, 0.95}) {
    Room room = make_floor();
    const Block block{4.2, 4.1, gap, gap + 1, 1.5, 1.5, 0.3};
    add_block(room, block, true, 1, 1);
    add_quad(room, 1, {0, 0, 4}, {0, 8, 0}, {8, 0, 0}, 1, 1);
    const Mesh mesh = make_mesh(room, {});
    Work work;
    const auto find_factor = [&](const Vertex& vertex) {
      double factor = 0;
      for (const Patch& lamp : mesh.patches)
        if (lamp.material == 1) factor += eval_factor({mesh, {}}, vertex, lamp, work);
      return factor;
    };
    double worst = 0;
    std::size_t patches = 0;
    for (const Patch& patch : mesh.patches) {
      if (patch.face != 0) continue;
      double mean = 0;
      for (const auto corner : patch.corners) mean += find_factor(mesh.vertices[corner]) / 4;
      worst = std::max(worst, std::abs(mean - find_factor(make_centre(patch))));
      ++patches;
    }
    std::printf("gap %.3f: %zu patches of the floor, off by %.3f at most\n", gap, patches, worst);
    EXPECT_LT(worst, 0.08);
  }
}

// Around the foot of an upright edge, each sector between two creases must have its own light.
TEST(Contacts, AtTheFootOfAnEdgeLightDependsOnTheSide) {
  Room room = make_floor();
  const Block block{4.2, 4.1, 0, 1, 1.5, 1.5, 0.3};
  add_block(room, block, false, 1, 1);
  add_quad(room, 1, {1, 6, 4}, {0, 1, 0}, {1, 0, 0}, 1, 1);
  choose_creases(room, Creases::found);
  const Mesh mesh = make_mesh(room, {});
  const Surroundings around = find_surroundings(mesh);
  std::size_t most = 0;
  for (const Vec& foot : block.ring(0)) {
    std::size_t ways = 0;  // number of directions from the foot along creases, outside the block
    for (const Crease& crease : room.creases) {
      if (crease.a.z != 0 || crease.b.z != 0 || eval_distance(foot, crease.a, crease.b) > 1e-9)
        continue;
      for (const Vec& end : {crease.a, crease.b})
        if (const double far = length(end - foot); far > 1e-9)
          ways += !is_within(block, foot + 0.01 / far * (end - foot), -1e-6);
    }
    std::size_t sides = 0;
    for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
      const Vertex& vertex = mesh.vertices[v];
      if (vertex.object != 0 || length(vertex.at - foot) > 1e-9) continue;
      if (is_within(block, vertex.lit, 0)) continue;
      ++sides;
      const auto lies_on = [&](std::uint32_t p) {
        const auto edges = make_edge_planes(mesh.patches[p].at, mesh.patches[p].normal);
        return std::ranges::all_of(
            edges, [&](const Plane& edge) { return eval_height(edge, vertex.lit) > 1e-6; });
      };
      EXPECT_TRUE(std::ranges::any_of(around.of(v), lies_on)) << "on a crease";
    }
    EXPECT_EQ(sides > 1, ways > 0);
    most = std::max(most, sides);
  }
  EXPECT_EQ(most, 4u);
  // Away from the feet, creases must not move the points where vertices are lit.
  for (const Vertex& vertex : mesh.vertices) {
    if (vertex.object != 0 || vertex.at.x == 0 || vertex.at.x == 8 || vertex.at.y == 0 ||
        vertex.at.y == 8)
      continue;
    const auto ring = block.ring(0);
    double away = 1e300;
    for (std::size_t i = 0; i < 4; ++i)
      away = std::min(away, eval_distance(vertex.at, ring[i], ring[(i + 1) % 4]));
    if (away > 0.1) {
      EXPECT_EQ(length(vertex.lit - vertex.at), 0);
    }
  }
}

// At the end of a screen, each side of the screen and each sector between creases must have its own
// light.
TEST(Contacts, AtTheEndOfAScreenLightDependsOnTheSide) {
  for (const double turn : {0.0, 0.3}) {
    Room room = make_floor();
    const Vec end{4.3, 4, 0}, way{2.4 * std::cos(turn), 2.4 * std::sin(turn), 0};
    add_quad(room, 0, end, way, {0, 0, 1}, 2, 1);
    room.faces.back().two_sided = true;
    const auto count = [&](std::vector<Crease> creases) {
      room.creases = std::move(creases);
      const Mesh mesh = make_mesh(room, {});
      std::size_t sides = 0;
      for (const Vertex& vertex : mesh.vertices)
        if (vertex.object == 0 && length(vertex.at - end) < 1e-9) {
          ++sides;
          EXPECT_GT(length(vertex.lit - vertex.at), 1e-3);
        }
      return sides;
    };
    EXPECT_EQ(count({}), 1u);
    EXPECT_GE(count({{end, {2.1, 1.3, 0}}, {end, {1.2, 3.1, 0}}}), 2u);
  }
}

// The shadow along a contact may be so narrow that the patches are not divided at its border. It
// must then not spread over a whole patch.
TEST(Contacts, VerticesAtAFootAreLitBeyondCreasesThatAreNotKept) {
  Room room = make_floor();
  const Block block{4.2, 4.1, 0, 1, 1.5, 1.5, 0.3};
  add_block(room, block, false, 1, 1);
  const auto foot = block.ring(0);
  const Vec outward = normalize(cross(foot[1] - foot[0], {0, 0, 1}));
  const auto find_lit = [&](std::vector<Crease> creases) {
    room.creases = std::move(creases);
    const Mesh mesh = make_mesh(room, {});
    std::vector<double> before;  // distances of lit points from the foot of the block
    for (const Vertex& vertex : mesh.vertices) {
      const double along = dot(vertex.at - foot[0], normalize(foot[1] - foot[0]));
      if (vertex.object == 0 && along > 0.2 && along < 2.8 &&
          std::abs(dot(vertex.at - foot[0], outward)) < 1e-9 &&
          dot(vertex.lit - foot[0], outward) > 0)
        before.push_back(dot(vertex.lit - foot[0], outward));
    }
    EXPECT_GE(before.size(), 2u);
    return before;
  };
  const auto beside = [&](double away) {
    return Crease{foot[0] + away * outward, foot[1] + away * outward};
  };
  for (const double lit : find_lit({})) EXPECT_LT(lit, 0.02);
  for (const double lit : find_lit({beside(0.05)})) {
    EXPECT_GT(lit, 0.05);
    EXPECT_LT(lit, 0.07);
  }
  // A crease that crosses the foot, and one that is an edge of patches, must have no effect.
  const Vec middle = 0.5 * (foot[0] + foot[1]);
  for (const double lit : find_lit({{middle, middle + outward}})) EXPECT_LT(lit, 0.02);
  for (const double lit : find_lit({beside(0.3)})) EXPECT_LT(lit, 0.02);
}

}  // namespace
}  // namespace radiosity::test
