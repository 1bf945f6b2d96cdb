#pragma once
// A room for tests of pictures, with a known illumination at every point.

#include "renderer/radiosity/show/picture.hpp"
#include "tests/renderer/support.hpp"

namespace radiosity::test {

using renderer::test::Random;

inline Face make_face(std::vector<Vec> corners, int along = 1, int across = 1) {
  Face face;
  face.corners = std::move(corners);
  face.along = along;
  face.across = across;
  return face;
}

/// A room without faces. Material 0 is diffuse and emits light; material 1 is a mirror whose
/// reflectance is different for each colour.
inline Room make_empty_room() {
  Room room;
  room.materials = {{"wall", {0.5, 0.5, 0.5}, {1, 1, 1}, false},
                    {"mirror", {0.9, 0.8, 0.7}, {}, true}};
  room.view.from = {0.31, 0.22, 0.93};
  room.view.at = {0.5, 0.55, 0.1};
  room.view.up = {0, 1, 0};
  room.view.angle = 90;
  return room;
}

/// The unit cube, with its fronts inside. Faces 0 and 1 are at x = 0 and 1, faces 2 and 3 at y = 0
/// and 1, faces 4 and 5 at z = 0 and 1.
inline Room make_cube(int divide) {
  Room room = make_empty_room();
  const auto add = [&](const Vec& o, const Vec& a, const Vec& b) {
    room.faces.push_back(make_face({o, o + a, o + a + b, o + b}, divide, divide + 1));
  };
  const Vec x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, o{};
  add(o, y, z);
  add(x, z, y);
  add(o, z, x);
  add(y, x, z);
  add(o, x, y);
  add(z, y, x);
  return room;
}

/// The unit cube with a two-sided triangle, a two-sided pentagon, and two quads back to back in it.
inline Room make_furnished_cube(int divide) {
  Room room = make_cube(divide);
  room.faces.push_back(make_face({{0.2, 0.2, 0.3}, {0.7, 0.3, 0.2}, {0.4, 0.8, 0.5}}, divide));
  room.faces.back().two_sided = true;
  room.faces.push_back(make_face(
      {{0.6, 0.1, 0.3}, {0.9, 0.1, 0.3}, {0.95, 0.3, 0.4}, {0.75, 0.5, 0.5}, {0.55, 0.3, 0.4}},
      divide));
  room.faces.back().two_sided = true;
  const Vec a{0.1, 0.6, 0.2}, b{0.3, 0.61, 0.25}, c{0.28, 0.9, 0.3}, d{0.08, 0.89, 0.25};
  room.faces.push_back(make_face({a, b, c, d}, divide, divide));
  room.faces.push_back(make_face({b, a, d, c}, divide, divide));
  return room;
}

/// A radiosity that is linear in space, and positive in the unit cube. Any patch reproduces it
/// exactly.
inline Rgb eval_linear(const Vec& p) {
  return {1 + p.x, 2 + p.y - 0.5 * p.z, 1.5 - 0.3 * p.x + p.z};
}

inline std::vector<Rgb> make_linear(const Mesh& mesh) {
  std::vector<Rgb> values;
  for (const Vertex& vertex : mesh.vertices) values.push_back(eval_linear(vertex.at));
  return values;
}

inline Illumination make_illumination(const Mesh& mesh, const std::vector<Rgb>& values,
                                      Reconstruction kind = Reconstruction::bilinear) {
  return reconstruct(mesh, values, {kind, Twist::estimated});
}

inline double distance(const Rgb& a, const Rgb& b) {
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

/// The direction of the ray through the centre of pixel (x, y).
inline Vec eval_way(const renderer::View& view, const PictureParams& params, int x, int y) {
  const Vec ahead = normalize(view.at - view.from), right = normalize(cross(ahead, view.up));
  const double half = std::tan(view.angle * std::numbers::pi / 360),
               step = 2 * half / params.height;
  return normalize(ahead + (x + 0.5 - params.width / 2.0) * step * right +
                   (params.height / 2.0 - y - 0.5) * step * cross(right, ahead));
}

/// The distance in direction `way` from a point in the unit cube to its border.
inline double eval_reach(const Vec& from, const Vec& way) {
  double reach = renderer::Bounds::INF;
  for (int axis = 0; axis < 3; ++axis)
    if (way[axis] != 0) reach = std::min(reach, ((way[axis] > 0) - from[axis]) / way[axis]);
  return reach;
}

}  // namespace radiosity::test
