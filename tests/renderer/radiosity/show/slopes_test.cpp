// Tests the tangent planes of the illumination: thesis Eq 3.5 to 3.7, and the rules for borders.

#include "renderer/radiosity/show/slopes.hpp"

#include <gtest/gtest.h>

#include "tests/renderer/radiosity/mesh/grids.hpp"

namespace radiosity::grids {
namespace {

Vec red(const Slopes<Rgb>& slopes) { return {slopes.x.r, slopes.y.r, slopes.z.r}; }

std::vector<Slopes<Rgb>> find(const Mesh& mesh, std::span<const Rgb> values) {
  return find_slopes(mesh, make_fans(mesh), values);
}

// An edge of a patch, from one corner to the next.
struct Edge {
  Vec at, to;
};
Edge find_edge(const Mesh& mesh, std::uint32_t patch, std::uint32_t corner) {
  const auto& corners = mesh.patches[patch].corners;
  return {mesh.vertices[corners[corner]].at, mesh.vertices[corners[(corner + 1) % 4]].at};
}

// A cylinder of facets that have the cylinder's normals. u runs around the cylinder and v along it.
Vertex place_on_cylinder(double u, double v) {
  const double angle = 0.3 + 2 * u;
  const Vec normal{std::cos(angle), std::sin(angle), 0};
  const Vec at = 2 * normal + Vec{0, 0, 3 * v};
  return {at, at, normal, 0, 0};
}

TEST(Slopes, OfAnEvenGridAreCentralDifferences) {
  Random random{1};
  const Mesh mesh = make_grid(make_lines(4), make_lines(3), make_plane(random));
  const std::vector<Rgb> values = make_colours(random, mesh.vertices.size());
  const auto slopes = find(mesh, values);
  for (const std::uint32_t v : {6u, 7u, 8u, 11u, 12u, 13u}) {
    const Vec u = mesh.vertices[v + 1].at - mesh.vertices[v].at;
    const Vec w = mesh.vertices[v + 5].at - mesh.vertices[v].at;
    EXPECT_NEAR(along(slopes[v], u).r, (values[v + 1].r - values[v - 1].r) / 2, 1e-12);
    EXPECT_NEAR(along(slopes[v], w).b, (values[v + 5].b - values[v - 5].b) / 2, 1e-12);
    EXPECT_NEAR(dot(red(slopes[v]), mesh.vertices[v].normal), 0, 1e-12);
  }
}

// Follows thesis figures 3.3 and 3.4 literally: lifts points by B along the geometric normal, takes
// the normal N_i of each plane through lifted points, and averages these normals.
TEST(Slopes, AreTheMeanOfTheNormalsOfFigure34) {
  Random random{2};
  const Mesh mesh = make_grid(make_lines(2), make_lines(2), make_plane(random));
  const std::vector<Rgb> values = make_colours(random, 9);
  const Vec ng = mesh.vertices[4].normal;
  const auto lift = [&](std::uint32_t v) { return mesh.vertices[v].at + values[v].g * ng; };
  Vec sum;
  for (const auto& [next, prev] : {std::pair{5u, 7u}, {7u, 3u}, {3u, 1u}, {1u, 5u}}) {
    const Vec n = cross(lift(next) - lift(4), lift(prev) - lift(4));
    sum += (1 / dot(n, ng)) * n;
  }
  const auto slopes = find(mesh, values)[4];
  const Vec green{slopes.x.g, slopes.y.g, slopes.z.g};
  EXPECT_NEAR(length(0.25 * sum - (ng - green)), 0, 1e-12);
}

TEST(Slopes, AlongAnEdgeAreEq37TimesItsLengthOnFlatAndCurvedSurfaces) {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    const auto surface = seed % 2 ? make_plane(random) : place_on_cylinder;
    const Mesh mesh = make_grid(make_lines(4, &random), make_lines(3, &random), surface);
    const auto slopes = find(mesh, make_colours(random, mesh.vertices.size()));
    for (std::uint32_t p = 0; p < mesh.patches.size(); ++p)
      for (std::uint32_t c = 0; c < 4; ++c) {
        const std::uint32_t v = mesh.patches[p].corners[c];
        const Edge edge = find_edge(mesh, p, c);
        const Vec d = edge.to - edge.at, ng = mesh.vertices[v].normal;
        const Vec ni = normalize(ng - red(slopes[v]));
        const Vec across = normalize(cross(ng, d));  // normal of the plane spanned by N_g and d
        const Vec nid = ni - dot(ni, across) * across;
        const Vec n = cross(cross(ni, ng), ng);
        const double sign = dot(n, d) < 0 ? -1 : 1;
        EXPECT_NEAR(along(slopes[v], unfold(mesh.vertices[v], edge.to)).r,
                    sign * length(cross(ng, nid)) / dot(ng, nid) * length(d), 1e-9);
      }
  }
}

// Thesis figure 3.7: the function falls from left to right, for any directions of the patches'
// edges.
TEST(Slopes, RiseInOneHalfSpaceAndFallInTheOther) {
  const Mesh mesh = make_grid(make_lines(6), make_lines(2), place_on_cylinder);
  std::vector<Rgb> values;
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v)
    values.push_back({10.0 - v % 7, 1.0 * (v % 7), 5});
  const auto slopes = find(mesh, values);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    const Vertex& vertex = mesh.vertices[v];
    if (v % 7 < 6) {
      const Rgb d1 = along(slopes[v], unfold(vertex, mesh.vertices[v + 1].at));
      EXPECT_NEAR(d1.r, -1, 1e-9);
      EXPECT_NEAR(d1.g, 1, 1e-9);
    }
    if (v % 7 > 0) {
      const Rgb d2 = along(slopes[v], unfold(vertex, mesh.vertices[v - 1].at));
      EXPECT_NEAR(d2.r, 1, 1e-9);
      EXPECT_NEAR(d2.g, -1, 1e-9);
    }
    EXPECT_NEAR(renderer::length({slopes[v].x.b, slopes[v].y.b, slopes[v].z.b}), 0, 1e-12);
  }
}

// Thesis figure 3.5: V_1 and V_4 take the slope of the parabola, V_2 and V_3 that of their
// neighbours.
TEST(Slopes, AtBordersAreTheParabolas) {
  Random random{3};
  const Mesh mesh = make_grid(make_lines(3), make_lines(1), make_plane(random));
  const std::vector<Rgb> values = make_colours(random, 8);
  const auto slopes = find(mesh, values);
  for (const std::uint32_t row : {0u, 4u}) {
    const auto b = [&](std::uint32_t i) { return values[row + i].r; };
    const Vec h = mesh.vertices[row + 1].at - mesh.vertices[row].at;
    const auto slope = [&](std::uint32_t i) { return along(slopes[row + i], h).r; };
    EXPECT_NEAR(slope(1), (b(2) - b(0)) / 2, 1e-12);
    EXPECT_NEAR(slope(2), (b(3) - b(1)) / 2, 1e-12);
    EXPECT_NEAR(slope(0), 2 * (b(1) - b(0)) - slope(1), 1e-12);
    EXPECT_NEAR(slope(3), 2 * (b(3) - b(2)) - slope(2), 1e-12);
  }
  // In the other direction, both ends are on borders, so that the function is a straight line.
  const Vec up = mesh.vertices[4].at - mesh.vertices[0].at;
  for (std::uint32_t v = 0; v < 8; ++v)
    EXPECT_NEAR(along(slopes[v], up).r, values[v % 4 + 4].r - values[v % 4].r, 1e-12);
}

// Along a straight border, slopes depend only on the vertices of the border. The slope along a
// crease is therefore the same on both sides, even if their patches differ.
TEST(Slopes, AlongAStraightBorderDependOnItsVerticesOnly) {
  Random random{5};
  const auto plane = make_plane(random, true);
  Mesh mesh;  // half a disc: three uneven quads around the first vertex
  for (const auto& [u, v] : {std::pair{0.0, 0.0},
                             {1.0, 0.0},
                             {0.9, 0.9},
                             {0.6, 0.8},
                             {0.0, 1.2},
                             {-0.5, 0.9},
                             {-1.0, 0.8},
                             {-1.5, 0.0}})
    mesh.vertices.push_back(plane(u, v));
  for (const std::uint32_t first : {1u, 3u, 5u}) add_patch(mesh, {0, first, first + 1, first + 2});
  const std::vector<Rgb> values = make_colours(random, 8);
  const auto slopes = find(mesh, values)[0];
  const double to_a = values[1].r - values[0].r, to_b = (values[7].r - values[0].r) / 1.5;
  EXPECT_NEAR(along(slopes, mesh.vertices[1].at - mesh.vertices[0].at).r, (1.5 * to_a - to_b) / 2.5,
              1e-12);
}

// If slopes change only by turning with the surface, they count as constant, so that mixed
// derivatives are zero.
TEST(Twists, DoNotMistakeTheTurnOfACurvedSurfaceForAChange) {
  const auto helix = [](double u, double v) { return place_on_cylinder(u + v / 3, v); };
  const Mesh mesh = make_grid(make_lines(4), make_lines(4), helix);
  std::vector<Slopes<Rgb>> slopes;
  for (const Vertex& vertex : mesh.vertices) {
    const Vec way = 3 * cross({0, 0, 1}, vertex.normal) + Vec{0, 0, 2};
    slopes.push_back({{way.x, 0, 0}, {way.y, 0, 0}, {way.z, 0, 0}});
  }
  const Fans fans = make_fans(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    const auto bend = find_bend(mesh, fans, slopes, v);
    for (const auto& change : {bend.x, bend.y, bend.z})
      EXPECT_NEAR(renderer::length(red(change)), 0, 1e-12);
  }
}

TEST(Fans, TellVerticesInsideFromBordersAndCorners) {
  Random random{4};
  Mesh mesh = make_grid(make_lines(3), make_lines(2), make_plane(random), &random);
  mesh.vertices.emplace_back();  // a vertex without patches
  const Fans fans = make_fans(mesh);
  for (std::uint32_t v = 0; v < 12; ++v) {
    const bool side = v % 4 == 0 || v % 4 == 3, end = v / 4 != 1;
    EXPECT_EQ(fans.places[v], side && end   ? Place::corner
                              : side || end ? Place::straight
                                            : Place::inner)
        << v;
    EXPECT_EQ(fans.at(v).size(), (side ? 1u : 2u) * (end ? 1u : 2u)) << v;
  }
  EXPECT_EQ(fans.places[12], Place::corner);
  EXPECT_TRUE(fans.at(12).empty());
}

}  // namespace
}  // namespace radiosity::grids
