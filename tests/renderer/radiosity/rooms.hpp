#pragma once
// Rooms for tests: small ones, random ones, and rooms written as text.

#include <fmt/format.h>

#include <sstream>

#include "base/errors.hpp"
#include "renderer/radiosity/files/load_room.hpp"
#include "tests/renderer/support.hpp"

namespace radiosity::test {

using renderer::test::Random;

/// A square lamp and a wall that enclose nothing: the smallest room that passes check().
inline Room make_small_room() {
  Room room;
  room.materials = {{"wall", {0.5, 0.5, 0.5}, {}, false}, {"lamp", {0, 0, 0}, {1, 1, 1}, false}};
  room.faces.resize(2);
  room.faces[0].corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  room.faces[1].corners = {{0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1}};
  room.faces[1].material = 1;
  return room;
}

/// A convex polygon whose corners lie on an ellipse in a random plane.
inline std::vector<Vec> make_convex(Random& random, int corners) {
  const Vec centre = random.point(5);
  const auto [u, v] = renderer::test::make_plane(random.direction());
  const double wide = random.range(0.1, 3), high = random.range(0.1, 3);
  std::vector<Vec> points;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * (i + random.range(0, 0.6)) / corners;
    points.push_back(centre + wide * std::cos(angle) * u + high * std::sin(angle) * v);
  }
  return points;
}

inline Room make_random_room(std::uint64_t seed) {
  Random random{seed};
  Room room;
  const int materials = 1 + random.below(6);
  for (int i = 0; i < materials; ++i) {
    Material m;
    m.name = fmt::format("m{}", i);
    m.mirror = i > 0 && random.below(3) == 0;
    m.reflectance = random.colour();
    if (i == 0 || (!m.mirror && random.below(2) == 0)) m.emission = 30 * random.colour();
    room.materials.push_back(m);
  }
  const int faces = 1 + random.below(20);
  for (int i = 0; i < faces; ++i) {
    Face face;
    face.corners = make_convex(random, 3 + random.below(6));
    face.material = static_cast<std::uint32_t>(i == 0 ? 0 : random.below(materials));
    face.two_sided = random.below(2) == 0;
    face.along = 1 + random.below(20);
    face.across = face.corners.size() == 4 ? 1 + random.below(20) : face.along;
    room.faces.push_back(face);
  }
  for (int i = random.below(4); i > 0; --i) {
    // The crease leads from a corner of the face to one of its sides.
    const auto& on = room.faces[static_cast<std::size_t>(random.below(faces))].corners;
    room.creases.push_back({on[0], on[1] + random.range(0.1, 0.9) * (on[2] - on[1])});
  }
  room.view.from = random.point(9);
  room.view.at = random.point(1);
  room.view.up = random.direction();
  room.view.angle = random.range(10, 120);
  room.view.width = 1 + random.below(999);
  room.view.height = 1 + random.below(999);
  return room;
}

inline std::string write(const Vec& v) { return fmt::format(" {} {} {}", v.x, v.y, v.z); }
inline std::string write(const Rgb& c) { return fmt::format(" {} {} {}", c.r, c.g, c.b); }

/// Writes the room as text for read_room(), with every statement that a face needs.
inline std::string write(const Room& room) {
  std::string text = "# a room\n";
  for (const Material& m : room.materials) {
    text += fmt::format("{} {} reflect{}", m.mirror ? "mirror" : "material", m.name,
                        write(m.reflectance));
    if (max_component(m.emission) > 0) text += " emit" + write(m.emission);
    text += "  # so much\n\n";
  }
  for (const Face& f : room.faces) {
    const bool quad = f.corners.size() == 4 && (f.along != f.across || f.two_sided);
    text += fmt::format("{} {}", quad ? "quad" : "polygon", room.materials[f.material].name);
    for (const Vec& c : f.corners) text += " " + write(c);
    if (quad)
      text += fmt::format("\tdivide {} {}", f.along, f.across);
    else if (f.along > 1)
      text += fmt::format(" divide {}", f.along);
    text += f.two_sided ? " two-sided\r\n" : "\n";
  }
  for (const Crease& c : room.creases) text += "crease" + write(c.a) + write(c.b) + "\n";
  const renderer::View& v = room.view;
  return text + fmt::format("view from{} at{} up{} angle {} size {} {}\n", write(v.from),
                            write(v.at), write(v.up), v.angle, v.width, v.height);
}

inline Room read(const std::string& text) { return read_room(text, "test.room"); }

/// The message of the BadInput that `action` throws, or "accepted".
template <typename Action>
std::string get_error(const Action& action) {
  try {
    action();
  } catch (const base::BadInput& bad) {
    return bad.what();
  }
  return "accepted";
}

}  // namespace radiosity::test
