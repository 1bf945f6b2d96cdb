#pragma once
// Random closed surfaces of polygons, for tests.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "renderer/scene/triangulate.hpp"
#include "tests/renderer/support.hpp"

namespace renderer::test {

// A closed surface. All of it is visible from points near its middle.
struct Closed {
  std::vector<Vec> points;
  std::vector<std::vector<std::uint32_t>> faces;
  Vec middle;
  double size = 1;
};

inline std::uint32_t add_point(Closed& mesh, const Vec& point) {
  const auto index = std::ranges::find(mesh.points, point) - mesh.points.begin();
  if (index == std::ssize(mesh.points)) mesh.points.push_back(point);
  return static_cast<std::uint32_t>(index);
}

// A cube from -1 to 1. Each side is divided into side x side squares.
inline Closed make_cube(int side) {
  Closed mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const double end : {-1.0, 1.0})
      for (int i = 0; i < side * side; ++i) {
        const auto at = [&](int u, int v) {
          const double a = 2.0 * u / side - 1, b = 2.0 * v / side - 1;
          return add_point(mesh, axis == 0   ? Vec{end, a, b}
                                 : axis == 1 ? Vec{a, end, b}
                                             : Vec{a, b, end});
        };
        const int u = i % side, v = i / side;
        mesh.faces.push_back({at(u, v), at(u + 1, v), at(u + 1, v + 1), at(u, v + 1)});
      }
  return mesh;
}

// A ball of rings of quads and two triangle fans. Its radius varies randomly by the fraction
// `vary`, so that the quads are bent.
inline Closed make_ball(Random& random, int rings, int sectors, double vary = 0.1) {
  Closed mesh;
  const auto place = [&](double polar, double around) {
    const double r = random.range(1 - vary, 1 + vary);
    return Vec{r * std::sin(polar) * std::cos(around), r * std::sin(polar) * std::sin(around),
               r * std::cos(polar)};
  };
  mesh.points = {place(0, 0), place(std::numbers::pi, 0)};
  for (int i = 1; i < rings; ++i)
    for (int k = 0; k < sectors; ++k)
      mesh.points.push_back(
          place(std::numbers::pi * i / rings, 2 * std::numbers::pi * k / sectors));
  const auto at = [&](int i, int k) {
    return static_cast<std::uint32_t>(i == 0       ? 0
                                      : i == rings ? 1
                                                   : 2 + (i - 1) * sectors + k % sectors);
  };
  for (int i = 0; i < rings; ++i)
    for (int k = 0; k < sectors; ++k) {
      mesh.faces.push_back({at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)});
      auto& face = mesh.faces.back();
      if (i == 0) face.pop_back();
      if (i == rings - 1) face.erase(face.begin() + 1);
    }
  return mesh;
}

// A prism over a star. It is mostly concave.
inline Closed make_prism(Random& random) {
  Closed mesh;
  const int corners = 3 + random.below(9);
  std::vector<std::uint32_t> bottom, top;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners, r = random.range(0.7, 1.2);
    const Vec at{r * std::cos(angle), r * std::sin(angle), -0.8};
    bottom.push_back(add_point(mesh, at));
    top.push_back(add_point(mesh, at + Vec{0.1, 0.05, 1.6}));
  }
  mesh.faces = {bottom, top};
  for (std::size_t i = 0, j = bottom.size() - 1; i < bottom.size(); j = i++)
    mesh.faces.push_back({bottom[j], bottom[i], top[i], top[j]});
  return mesh;
}

inline std::vector<Vec> find_corners(const Closed& mesh, const std::vector<std::uint32_t>& face) {
  std::vector<Vec> corners;
  for (const auto i : face) corners.push_back(mesh.points[i]);
  return corners;
}

inline bool is_valid(const std::vector<Vec>& corners) {
  try {
    check_polygon(corners, {});
    return true;
  } catch (const base::BadInput&) {
    return false;
  }
}

// Splits some quads, and all quads that are bent too much. Reverses some faces.
inline void vary_faces(Random& random, Closed& mesh) {
  std::vector<std::vector<std::uint32_t>> faces;
  const bool splits = random.below(2) == 0;
  for (const auto& face : mesh.faces) {
    if (face.size() == 4 && (splits || !is_valid(find_corners(mesh, face)))) {
      faces.push_back({face[0], face[1], face[2]});
      faces.push_back({face[0], face[2], face[3]});
    } else {
      faces.push_back(face);
    }
  }
  for (auto& face : faces)
    if (random.below(2) == 0) std::ranges::reverse(face);
  mesh.faces = faces;
}

// Rotates, scales and moves the mesh. Some meshes stay parallel to the axes, with round
// coordinates.
inline void place(Random& random, Closed& mesh) {
  if (random.below(4) == 0) return;
  const Vec n = random.direction();
  const auto [u, v] = make_plane(n);
  mesh.size = std::pow(10, random.range(-3, 3));
  mesh.middle = mesh.size * random.point(random.below(2) == 0 ? 1 : 1000);
  for (Vec& p : mesh.points)
    p = mesh.middle + (mesh.size * p.x) * u + (mesh.size * p.y) * v + (mesh.size * p.z) * n;
}

inline Closed make_closed(std::uint64_t seed) {
  Random random{seed};
  const int kind = random.below(3);
  Closed mesh = kind == 0   ? make_cube(1 + random.below(4))
                : kind == 1 ? make_ball(random, 3 + random.below(6), 5 + random.below(8))
                            : make_prism(random);
  place(random, mesh);
  vary_faces(random, mesh);
  return mesh;
}

// Makes a scene from the mesh. With `patches`, faces have interpolated normals; with `moves`, the
// mesh moves.
inline Scene make_scene(const Closed& mesh, bool patches, bool moves) {
  Scene scene;
  scene.surfaces.emplace_back();
  scene.view.from = mesh.middle + Vec{0, 0, 5 * mesh.size};
  scene.view.at = mesh.middle;
  for (const auto& face : mesh.faces) {
    const auto corners = find_corners(mesh, face);
    std::vector<Vec> normals;
    for (const Vec& corner : corners) normals.push_back(corner - mesh.middle);
    patches ? add_patch(scene, corners, normals) : add_polygon(scene, corners);
  }
  if (moves) scene.moves.assign(mesh.faces.size(), mesh.size * Vec{0.3, -0.2, 0.1});
  finish(scene);
  return scene;
}

// A corner of the mesh, or a point of an edge.
struct Target {
  Vec at;
  std::vector<std::uint32_t> corners;  // one corner, or the two ends of the edge
};

inline Target choose_target(Random& random, const Closed& mesh) {
  const auto& face = mesh.faces[static_cast<std::size_t>(random.below(int(mesh.faces.size())))];
  const auto i = static_cast<std::size_t>(random.below(static_cast<int>(face.size())));
  const std::uint32_t a = face[i], b = face[(i + 1) % face.size()];
  const Vec &p = mesh.points[a], &q = mesh.points[b];
  if (random.below(3) == 0) return {p, {a}};
  const double share = random.below(3) == 0 ? 0.5 : random.unit();
  return {p + share * (q - p), {a, b}};
}

}  // namespace renderer::test
