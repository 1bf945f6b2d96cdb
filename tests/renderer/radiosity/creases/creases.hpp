#pragma once
// Rooms for the tests of creases (lines at which the illumination or its derivatives jump).

#include "renderer/radiosity/creases/creases.hpp"
#include "tests/renderer/support.hpp"

namespace radiosity::test::shadows {

using renderer::test::Random;

using Polygon = std::vector<Vec>;

/// Indices of materials.
enum : std::uint32_t { GREY, LIGHT, MIRROR };

inline Room make_room() {
  Room room;
  room.materials = {{"grey", {0.5, 0.5, 0.5}, {}, false},
                    {"light", {}, {1, 1, 1}, false},
                    {"mirror", {1, 1, 1}, {}, true}};
  return room;
}

inline void add_face(Room& room, const Polygon& corners, std::uint32_t material,
                     bool two_sided = false) {
  Face face;
  face.corners = corners;
  face.material = material;
  face.two_sided = two_sided;
  room.faces.push_back(face);
}

/// A horizontal rectangle at height z, counter-clockwise as seen from above.
inline Polygon make_rectangle(double x0, double y0, double x1, double y1, double z) {
  return {{x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z}};
}

inline Polygon turn(Polygon polygon) {
  std::reverse(polygon.begin(), polygon.end());
  return polygon;
}

/// Adds the six faces of a box with their fronts outside if `outwards`, otherwise inside.
inline void add_box(Room& room, const Vec& lo, const Vec& hi, bool outwards) {
  const auto add = [&](const Vec& a, const Vec& b, const Vec& c, const Vec& d) {
    const Polygon inwards{a, b, c, d};
    add_face(room, outwards ? turn(inwards) : inwards, GREY);
  };
  const auto at = [&](int x, int y, int z) {
    return Vec{x ? hi.x : lo.x, y ? hi.y : lo.y, z ? hi.z : lo.z};
  };
  add(at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0));
  add(at(0, 0, 1), at(0, 1, 1), at(1, 1, 1), at(1, 0, 1));
  add(at(0, 0, 0), at(0, 1, 0), at(0, 1, 1), at(0, 0, 1));
  add(at(1, 0, 0), at(1, 0, 1), at(1, 1, 1), at(1, 1, 0));
  add(at(0, 0, 0), at(0, 0, 1), at(1, 0, 1), at(1, 0, 0));
  add(at(0, 1, 0), at(1, 1, 0), at(1, 1, 1), at(0, 1, 1));
}

inline double distance_to(const Vec& p, const Crease& c) {
  const Vec way = c.b - c.a;
  const double t = std::clamp(dot(p - c.a, way) / dot(way, way), 0.0, 1.0);
  return length(c.a + t * way - p);
}

inline double distance_to(const Vec& p, std::span<const Crease> creases) {
  double nearest = 1e9;
  for (const Crease& crease : creases) nearest = std::min(nearest, distance_to(p, crease));
  return nearest;
}

}  // namespace radiosity::test::shadows
