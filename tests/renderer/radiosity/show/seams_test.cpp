// Tests that two faces in one plane that are divided differently have equal illumination at their
// common edge.

#include "renderer/radiosity/show/seams.hpp"

#include <gtest/gtest.h>

#include "renderer/radiosity/show/slopes.hpp"
#include "tests/renderer/radiosity/mesh/grids.hpp"

namespace radiosity::grids {
namespace {

constexpr ReconstructionParams BOUNDED{Reconstruction::bicubic, Twist::estimated};

// A square of 2 x 2 in a random plane. It is cut along u = 1 into two faces, which are divided
// differently there.
struct Halves {
  Surface plane;
  Room room;

  Halves(Random& random, int left, int right) : plane(make_plane(random)) {
    room.materials.push_back({"white", {0.5, 0.5, 0.5}, {1, 1, 1}});
    add(0, left);
    add(1, right);
  }
  void add(double u, int across) {
    Face face;
    for (const auto& [a, b] : {std::pair{u, 0.0}, {u + 1, 0.0}, {u + 1, 2.0}, {u, 2.0}})
      face.corners.push_back(plane(a, b).at);
    face.along = 2;
    face.across = across;
    room.faces.push_back(face);
  }
};

// The illumination on the cut at the position v, evaluated on the patches of one face.
Rgb eval_at_cut(const Halves& halves, const Mesh& mesh, const Illumination& lit, std::uint32_t face,
                double v) {
  constexpr double S[] = {0, 1, 1, 0, 0}, T[] = {0, 0, 1, 1, 0};
  const Vec begin = halves.plane(1, 0).at, way = halves.plane(1, 2).at - begin;
  const auto find_share = [&](std::uint32_t vertex) {
    const Vec to = mesh.vertices[vertex].at - begin;
    const double share = dot(to, way) / dot(way, way);
    return length(to - share * way) < 1e-9 ? share : -1.0;
  };
  for (std::uint32_t p = 0; p < mesh.patches.size(); ++p)
    for (std::size_t i = 0; i < 4 && mesh.patches[p].face == face; ++i) {
      const double a = find_share(mesh.patches[p].corners[i]),
                   b = find_share(mesh.patches[p].corners[(i + 1) % 4]);
      if (a < 0 || b < 0 || v < std::min(a, b) || v > std::max(a, b)) continue;
      const double at = (v - a) / (b - a);
      return eval_illumination(lit, p, S[i] + at * (S[i + 1] - S[i]),
                               T[i] + at * (T[i + 1] - T[i]));
    }
  ADD_FAILURE() << "no patch at " << v;
  return {};
}

double find_gap(const Halves& halves, const Mesh& mesh, const Illumination& lit, Random& random) {
  double gap = 0;
  for (int i = 0; i < 50; ++i) {
    const double v = random.unit();
    gap = std::max(gap, eval_distance(eval_at_cut(halves, mesh, lit, 0, v),
                                      eval_at_cut(halves, mesh, lit, 1, v)));
  }
  return gap;
}

TEST(Seams, HaveNoGapsAndKeepLinearFunctions) {
  for (const auto& [left, right] : {std::pair{1, 2}, {3, 6}, {2, 10}, {6, 3}, {5, 1}})
    for (std::uint64_t seed = 1; seed <= 10; ++seed) {
      SCOPED_TRACE(testing::Message() << left << " and " << right << ", seed " << seed);
      Random random{seed};
      Halves halves(random, left, right);
      if (seed % 2 == 0)  // a crease that crosses the cut between vertices
        halves.room.creases.push_back({halves.plane(0, 0.86).at, halves.plane(2, 0.86).at});
      const Mesh mesh = make_mesh(halves.room, {});
      auto values = make_colours(random, mesh.vertices.size());
      const auto twins = find_twins(mesh);
      for (std::uint32_t v = 0; v < values.size(); ++v)
        for_twins(twins, v, [&](std::uint32_t twin) { values[twin] = values[v]; });
      const Vec way = random.point(1);
      const auto linear = [&](const Vec& at) { return Rgb{dot(at, way) + 20, 7, 20 - at.x}; };
      for (const auto& params : {BICUBIC, BOUNDED, BILINEAR}) {
        EXPECT_LT(find_gap(halves, mesh, reconstruct(mesh, values, params), random), 1e-9);
        EXPECT_LT(find_error(mesh, reconstruct(mesh, take(mesh, linear), params), linear), 1e-9);
      }
    }
}

// Three faces in one plane meet in a T. The longer seam contains an end of the shorter one.
TEST(Seams, ThatMeetInATHaveNoGaps) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const Surface plane = make_plane(random);
    Room room;
    room.materials.push_back({"white", {0.5, 0.5, 0.5}, {1, 1, 1}});
    const auto add = [&](double u0, double v0, double u1, double v1, int along) {
      Face face;
      for (const auto& [u, v] : {std::pair{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}})
        face.corners.push_back(plane(u, v).at);
      face.along = along;
      face.across = 1;
      room.faces.push_back(face);
    };
    add(-1, -0.5, 0, 0.5, 1);
    add(0, 0, 2, 0.5, 1);
    add(0, -0.5, 2, 0, 4);
    const Mesh mesh = make_mesh(room, {});
    const auto values = make_colours(random, mesh.vertices.size());
    for (const auto& params : {BICUBIC, BOUNDED, BILINEAR}) {
      const auto lit = reconstruct(mesh, values, params);
      const auto eval = [&](std::uint32_t p, const Vec& point) {
        const Patch& patch = mesh.patches[p];
        const Vec a = patch.at[1] - patch.at[0], b = patch.at[3] - patch.at[0];
        const Vec to = point - patch.at[0], n = cross(a, b);
        return eval_illumination(lit, p, dot(n, cross(to, b)) / dot(n, n),
                                 dot(n, cross(a, to)) / dot(n, n));
      };
      ASSERT_EQ(mesh.patches.size(), 6u);
      const double u = random.range(0, 2), v = random.range(-0.5, 0.5);
      const auto below = static_cast<std::uint32_t>(2 + std::min(3, int(u * 2)));
      EXPECT_LT(eval_distance(eval(1, plane(u, 0).at), eval(below, plane(u, 0).at)), 1e-9);
      EXPECT_LT(eval_distance(eval(0, plane(0, v).at), eval(v < 0 ? 2 : 1, plane(0, v).at)), 1e-9);
    }
  }
}

TEST(Seams, AreFoundOnceAndTheLongestFirst) {
  Random random{7};
  Halves halves(random, 2, 8);
  halves.room.faces[0].grid = {{0, 0.5, 1}, {0, 0.25, 1}};
  const Mesh mesh = make_mesh(halves.room, {});
  const auto seams = find_seams(mesh, find_twins(mesh));
  ASSERT_EQ(seams.size(), 2u);
  EXPECT_EQ(seams[0].stops.size(), 5u);
  EXPECT_EQ(seams[1].stops.size(), 1u);
  EXPECT_NEAR(seams[1].stops[0].share, 0.5, 1e-9);
}

TEST(Seams, AreNotWhereFacesAreDividedAlikeOrDoNotMeet) {
  Random random{8};
  const auto count = [](const Room& room) {
    const Mesh mesh = make_mesh(room, {});
    return find_seams(mesh, find_twins(mesh)).size();
  };
  EXPECT_EQ(count(Halves(random, 4, 4).room), 0u);
  EXPECT_EQ(count(Halves(random, 3, 5).room), 0u);
  Halves apart(random, 2, 4);
  for (Vec& corner : apart.room.faces[1].corners) corner += 0.1 * random.direction();
  EXPECT_EQ(count(apart.room), 0u);
}

}  // namespace
}  // namespace radiosity::grids
