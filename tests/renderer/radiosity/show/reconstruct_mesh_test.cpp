// Tests the illumination between vertices on meshes that are not grids: polygons, several faces,
// curved surfaces and creases.

#include <gtest/gtest.h>

#include <map>

#include "renderer/radiosity/mesh/borders.hpp"
#include "tests/renderer/radiosity/mesh/grids.hpp"

namespace radiosity::grids {
namespace {

// A regular polygon of radius 1 in a random plane.
Face make_polygon(Random& random, int corners, int along) {
  const auto plane = make_plane(random, true);
  Face face;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    face.corners.push_back(plane(std::cos(angle), std::sin(angle)).at);
  }
  face.along = face.across = along;
  return face;
}

Mesh mesh_of(const std::vector<Face>& faces) {
  Room room;
  room.materials.push_back({"white", {0.5, 0.5, 0.5}, {1, 1, 1}});
  room.faces = faces;
  return make_mesh(room, {});
}

// The largest difference of illumination between patches at their common edge. Edges are found by
// position.
double find_largest_gap(const Mesh& mesh, const Illumination& b, Random& random) {
  using Key = std::array<double, 3>;
  const auto key = [&](std::uint32_t v) {
    const Vec& at = mesh.vertices[v].at;
    return Key{at.x, at.y, at.z};
  };
  constexpr double S[] = {0, 1, 1, 0, 0}, T[] = {0, 0, 1, 1, 0};
  std::map<std::pair<Key, Key>, std::pair<std::uint32_t, std::size_t>> known;
  double gap = 0;
  int met = 0;
  for (std::uint32_t p = 0; p < mesh.patches.size(); ++p)
    for (std::size_t c = 0; c < 4; ++c) {
      const Key from = key(mesh.patches[p].corners[c]);
      const Key to = key(mesh.patches[p].corners[(c + 1) % 4]);
      known[{from, to}] = {p, c};
      const auto other = known.find({to, from});
      if (other == known.end()) continue;
      ++met;
      const double f = random.unit();
      const auto at = [&](std::uint32_t patch, std::size_t k, double way) {
        return eval_illumination(b, patch, S[k] + way * (S[k + 1] - S[k]),
                                 T[k] + way * (T[k + 1] - T[k]));
      };
      const auto [q, d] = other->second;
      gap = std::max(gap, eval_distance(at(p, c, f), at(q, d, 1 - f)));
    }
  EXPECT_TRUE(met > 0 || mesh.patches.size() == 1);
  return gap;
}

TEST(ReconstructMesh, PolygonsKeepLinearFunctionsAndHaveNoGaps) {
  for (int corners = 3; corners <= 7; ++corners)
    for (int along = 1; along <= 3; ++along) {
      SCOPED_TRACE(testing::Message() << corners << " corners, divided by " << along);
      Random random{static_cast<std::uint64_t>(10 * corners + along)};
      const Mesh mesh = mesh_of({make_polygon(random, corners, along)});
      const Vec way = random.point(1);
      const auto linear = [&](const Vec& at) { return Rgb{dot(at, way) + 20, 7, 20 - at.x}; };
      EXPECT_LT(find_error(mesh, reconstruct(mesh, take(mesh, linear), BICUBIC), linear), 1e-10);
      const auto values = make_colours(random, mesh.vertices.size());
      EXPECT_LT(find_largest_gap(mesh, reconstruct(mesh, values, BICUBIC), random), 1e-12);
    }
}

TEST(ReconstructMesh, PolygonsAreNearSmoothFunctionsAndDoNotOvershoot) {
  for (int corners = 3; corners <= 6; ++corners) {
    SCOPED_TRACE(testing::Message() << corners << " corners");
    Random random{static_cast<std::uint64_t>(corners)};
    const Face face = make_polygon(random, corners, 3);
    const Vec peak = 0.5 * (face.corners[0] + face.corners[1]);
    const auto bump = [&](const Vec& at) {
      const double b = 3 + 1 / (1 + dot(at - peak, at - peak));
      return Rgb{b, 7 - b, 1};
    };
    const Mesh mesh = mesh_of({face});
    const auto values = take(mesh, bump);
    const auto bicubic = reconstruct(mesh, values, BICUBIC);
    EXPECT_LT(find_error(mesh, bicubic, bump),
              find_error(mesh, reconstruct(mesh, values, BILINEAR), bump) / 2);
    const auto [low, high] =
        std::ranges::minmax(values, {}, [](const Rgb& value) { return value.r; });
    for (std::uint32_t p = 0; p < mesh.patches.size(); ++p)
      for (int n = 0; n < 50; ++n) {
        const double b = eval_illumination(bicubic, p, random.unit(), random.unit()).r;
        EXPECT_GT(b, low.r - 0.2 * (high.r - low.r));
        EXPECT_LT(b, high.r + 0.2 * (high.r - low.r));
      }
  }
}

// The surface must continue across faces with a common plane and material.
TEST(ReconstructMesh, FacesThatShareVerticesAreOneSurface) {
  Random random{1};
  const auto plane = make_plane(random);
  std::vector<Face> faces(2);
  faces[0].corners = {plane(0, 0).at, plane(1, 0).at, plane(1, 1).at, plane(0, 1).at};
  faces[1].corners = {plane(1, 1).at, plane(1, 0).at, plane(3, 0).at, plane(3, 1).at};
  for (Face& face : faces) face.along = face.across = 3;
  const Mesh mesh = mesh_of(faces);
  ASSERT_EQ(mesh.vertices.size(), 28u);
  const Vec a = random.point(1), b = random.point(1);
  const auto quadratic = [&](const Vec& at) {
    return Rgb{900 + dot(a, at) * dot(b, at), 900 + at.x * at.y, 900 - at.z * at.z};
  };
  const auto smooth = reconstruct(mesh, take(mesh, quadratic), BICUBIC);
  EXPECT_LT(find_error(mesh, smooth, quadratic), 1e-9);
}

// Random values for the vertices, equal where positions are equal.
std::vector<Rgb> make_values(const Mesh& mesh, Random& random) {
  std::map<std::array<double, 3>, Rgb> by_place;
  return take(mesh, [&](const Vec& at) {
    const Rgb colour = Rgb{9, 9, 9} + random.colour();
    return by_place.try_emplace({at.x, at.y, at.z}, colour).first->second;
  });
}

TEST(ReconstructMesh, CreasesLeaveNoGapsWhereverTheyCrossTurnAndEnd) {
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    SCOPED_TRACE(testing::Message() << "seed " << seed);
    Random random{seed};
    Mesh mesh =
        make_grid(make_lines(6, &random), make_lines(6, &random), make_plane(random), &random);
    Edges creases;
    for (std::uint32_t i = 0; i < 7; ++i)
      for (std::uint32_t j = 0; j < 6; ++j) {
        if (random.below(3) == 0) creases.insert({7 * i + j, 7 * i + j + 1});
        if (random.below(3) == 0) creases.insert({7 * j + i, 7 * (j + 1) + i});
      }
    split_at_creases(mesh, creases);
    ASSERT_GT(mesh.vertices.size(), 49u);
    const auto values = make_values(mesh, random);
    EXPECT_LT(find_largest_gap(mesh, reconstruct(mesh, values, BICUBIC), random), 1e-12);
  }
}

// The function is a roof whose ridge lies on a crease. Other creases must have no effect.
TEST(ReconstructMesh, AFunctionThatBreaksAtACreaseIsExact) {
  for (const bool creased : {true, false}) {
    Random random{3};
    const auto lines = make_lines(6, &random);
    Mesh mesh = make_grid(lines, lines, make_plane(random), &random);
    const Vec ridge = mesh.vertices[7 * 2].at;
    const Vec across = mesh.vertices[7 * 3].at - ridge;
    const Vec along = mesh.vertices[7 * 2 + 1].at - ridge;
    const Vec up = cross(cross(along, across), along);
    const auto roof = [&](const Vec& at) {
      const double height = dot(at - ridge, up) / dot(across, up);
      return Rgb{99 - std::abs(height), 99 + height, 9};
    };
    Edges creases;
    for (std::uint32_t i = 0; i < 6; ++i) {
      creases.insert({7 * i + 3, 7 * (i + 1) + 3});
      if (creased) creases.insert({7 * 2 + i, 7 * 2 + i + 1});
    }
    split_at_creases(mesh, creases);
    const double error = find_error(mesh, reconstruct(mesh, take(mesh, roof), BICUBIC), roof);
    if (creased)
      EXPECT_LT(error, 1e-11);
    else
      EXPECT_GT(error, 0.1);
  }
}

// The facets have the normals of a cylinder. The result must equal that on the unrolled, flat
// surface.
TEST(ReconstructMesh, ACylinderIsAsGoodAsItsPlane) {
  Random random{2};
  const auto u = make_lines(6), v = make_lines(3, &random);
  const double half = 1.0 / 6;  // half the angle of a facet
  const auto round = [&](double a, double b) {
    const Vec normal{std::cos(2 * a), std::sin(2 * a), 0};
    const Vec at = normal + Vec{0, 0, b};
    return Vertex{at, at, normal, 0, 0};
  };
  const auto rolled_out = [&](double a, double b) {
    const Vec at{2 * a * std::sin(half) / half, b, 0};  // replaces arcs by chords
    return Vertex{at, at, {0, 0, 1}, 0, 0};
  };
  const Mesh cylinder = make_grid(u, v, round), plane = make_grid(u, v, rolled_out);
  const auto values = make_colours(random, cylinder.vertices.size());
  for (const Twist twist : {Twist::zero, Twist::diagonal, Twist::estimated}) {
    const ReconstructionParams params = make_unlimited(twist);
    const auto a = reconstruct(cylinder, values, params), b = reconstruct(plane, values, params);
    for (std::uint32_t p = 0; p < cylinder.patches.size(); ++p) {
      const double s = random.unit(), t = random.unit();
      EXPECT_LT(eval_distance(eval_illumination(a, p, s, t), eval_illumination(b, p, s, t)), 1e-11);
    }
  }
}

}  // namespace
}  // namespace radiosity::grids
