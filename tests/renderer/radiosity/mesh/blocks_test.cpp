// Tests rooms with standing, hanging and leaning blocks. Their faces can be divided along all
// creases and contacts, and no light passes under blocks on a floor.

#include <gtest/gtest.h>

#include "renderer/radiosity/creases/creases.hpp"
#include "renderer/radiosity/mesh/contacts.hpp"
#include "tests/renderer/radiosity/blocks.hpp"
#include "tests/renderer/radiosity/mesh/divisions.hpp"

namespace radiosity::test {
namespace {

double measure_patch_width(const Face& face, int refine) {
  double least = 1e300;
  for (std::size_t i = 0; i < 4; ++i) {
    const double edge = length(face.corners[(i + 1) % 4] - face.corners[i]);
    least = std::min(least, edge / refine / (i % 2 == 0 ? face.along : face.across));
  }
  return least;
}

// Expects that no crease runs through the inside of a quad, more than `margin` from its border.
void check_not_crossed(const Face& face, const Division& division, std::span<const Crease> creases,
                       double margin) {
  const Vec normal = normalize(eval_area_normal(face.corners));
  const Plane plane = make_plane(normal, face.corners[0]);
  for (const auto& quad : division.quads) {
    std::vector<Vec> corners;
    for (const auto corner : quad) corners.push_back(division.points[corner]);
    const auto edges = make_edge_planes(corners, normal);
    for (const Crease& crease : creases) {
      if (std::abs(eval_height(plane, crease.a)) > 1e-9 ||
          std::abs(eval_height(plane, crease.b)) > 1e-9)
        continue;
      const auto inside = clip_segment(crease.a, crease.b, edges, margin);
      ASSERT_FALSE(inside && (inside->to - inside->from) * length(crease.b - crease.a) > margin)
          << "a patch is crossed";
    }
  }
}

// Expects that two patches of a face share the vertices of their common edge, except on creases and
// contacts.
void check_shared(const Mesh& mesh, std::span<const Crease> creases, double margin) {
  using Point = std::array<double, 3>;
  std::map<std::tuple<std::uint32_t, Point, Point>, std::vector<std::array<std::uint32_t, 2>>>
      sides;
  const auto key = [](const Vec& v) { return Point{v.x, v.y, v.z}; };
  for (const Patch& patch : mesh.patches)
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<std::uint32_t, 2> ends{patch.corners[i], patch.corners[(i + 1) % 4]};
      std::array<Point, 2> at{key(patch.at[i]), key(patch.at[(i + 1) % 4])};
      if (at[1] < at[0]) std::swap(at[0], at[1]), std::swap(ends[0], ends[1]);
      sides[{patch.object, at[0], at[1]}].push_back(ends);
    }
  for (const auto& [place, ends] : sides) {
    if (ends.size() < 2) continue;
    ASSERT_EQ(ends.size(), 2u);
    for (std::size_t i = 0; i < 2; ++i) {
      if (ends[0][i] == ends[1][i]) continue;
      const Vec& at = mesh.vertices[ends[0][i]].at;
      double nearest = 1e300;
      for (const Crease& crease : creases)
        nearest = std::min(nearest, eval_distance(at, crease.a, crease.b));
      ASSERT_LE(nearest, margin) << "vertices are doubled where there is no crease";
    }
  }
}

struct Count {
  std::size_t creases = 0, left_out = 0, patches = 0;
};

void check_room(const Room& room, int refine, Count& count) {
  const auto contacts = find_contacts(room, refine);
  const Mesh mesh = make_mesh(room, {.refine = refine});
  std::vector<Crease> all = room.creases;
  double widest = 0;
  for (std::size_t f = 0; f < room.faces.size(); ++f) {
    const Face& face = room.faces[f];
    const double width = measure_patch_width(face, refine);
    widest = std::max(widest, width);
    const Division division = divide_face(face, refine,
                                          {.creases = room.creases,
                                           .contacts = contacts[f].lines,
                                           .folds = contacts[f].folds,
                                           .strips = contacts[f].strips});
    check_division(face, refine, division);
    if (division.left_out == 0) {
      for (const auto* lines : {&contacts[f].lines, &contacts[f].folds, &contacts[f].strips})
        check_not_crossed(face, division, *lines, 0.004 * width);
      check_not_crossed(face, division, room.creases, 0.15 * width);
    }
    for (const auto* lines : {&contacts[f].lines, &contacts[f].folds})
      all.insert(all.end(), lines->begin(), lines->end());
    count.left_out += division.left_out;
    count.creases += contacts[f].lines.size();
    if (testing::Test::HasFailure()) return;
  }
  check_shared(mesh, all, 0.15 * widest);
  count.creases += room.creases.size();
  count.patches += mesh.patches.size();
}

TEST(Blocks, AnyRoomIsCutAlongItsCreases) {
  Count count;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Room room = make_blocks(seed).room;
    room.creases = find_creases(room);
    check_room(room, seed % 10 == 0 ? 4 : seed % 10 == 5 ? 2 : 1, count);
    if (testing::Test::HasFailure()) return;
  }
  std::printf("%zu of %zu creases left out; %zu patches\n", count.left_out, count.creases,
              count.patches);
  EXPECT_LT(count.left_out, count.creases / 100);
}

// If the creases would make too many patches, some creases are omitted, but the limit on patches
// must nearly be reached.
TEST(Blocks, CreasesAreLeftOutBeyondABudget) {
  std::size_t limited = 0;
  double emptiest = 1;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Room room = make_blocks(seed, 3).room;
    room.creases = find_creases(room);
    const auto make = [&](int growth) {
      MeshParams params;
      params.crease_growth = growth;
      return make_mesh(room, params);
    };
    const Mesh all = make(1000);
    std::size_t left_out = room.creases.size();
    for (const int growth : {3, 4, 6}) {
      const std::size_t allowed =
          std::max<std::size_t>(2000, static_cast<std::size_t>(growth) * count_patches(room, 1));
      const Mesh some = make(growth);
      EXPECT_LE(some.patches.size(), allowed);
      EXPECT_LE(some.left_out, left_out) << growth;
      left_out = some.left_out;
      if (all.patches.size() <= allowed) {
        EXPECT_EQ(some.patches.size(), all.patches.size());
        continue;
      }
      ++limited;
      // The number of strips below hanging objects is reduced first. After this, there may be
      // enough patches for all creases.
      const double full = double(some.patches.size()) / double(allowed);
      EXPECT_GT(full, 0.5);
      if (some.left_out > all.left_out) emptiest = std::min(emptiest, full);
    }
  }
  std::printf("%zu limited rooms, which have at least %.2f of the patches that they may\n", limited,
              emptiest);
  EXPECT_GT(limited, 15u);
  EXPECT_GT(emptiest, 0.8);
}

// A vertex at the foot of a block belongs either to the floor outside or to the floor under the
// block. Vertices under the block must be dark.
TEST(Blocks, NoLightPassesUnderThem) {
  std::size_t inside = 0, doubled = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    const BlocksRoom made = make_blocks(seed);
    const Mesh mesh = make_mesh(made.room, {});
    Work work;
    for (const Block& block : made.blocks) {
      if (block.low > 0) continue;
      for (const Patch& patch : mesh.patches) {
        if (patch.face != 0 || !is_within(block, patch.centre, 0)) continue;
        for (const auto corner : patch.corners) {
          const Vertex& vertex = mesh.vertices[corner];
          ++inside;
          doubled += is_within(block, vertex.at, 1e-9) ? 0 : 1;
          ASSERT_TRUE(is_within(block, vertex.lit, 0)) << vertex.at.x << ' ' << vertex.at.y;
          for (const Patch& lamp : mesh.patches)
            if (lamp.material == 1) {
              ASSERT_EQ(eval_factor({mesh, {}}, vertex, lamp, work), 0);
            }
        }
      }
    }
  }
  EXPECT_GT(inside, 500u);
  EXPECT_GT(doubled, 200u);
}

}  // namespace
}  // namespace radiosity::test
