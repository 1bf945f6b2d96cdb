#include "renderer/radiosity/creases/discontinuities.hpp"

#include <algorithm>

#include "renderer/radiosity/creases/critical.hpp"

namespace radiosity {

namespace {

// Shares of the room's size: what is rounding, and what is one line.
constexpr double TOLERANCE = 1e-6, SAME = 1e-5;
// Creases shorter than this share of their face are left out.
constexpr double SHORTEST = 1e-3;

struct Piece {
  Side side;
  std::size_t face;
  renderer::Bounds bounds;
};

template <typename Wanted>
std::vector<Piece> find_sides(const Room& room, const Wanted& wanted) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < room.faces.size(); ++i) {
    const Face& face = room.faces[i];
    if (!wanted(room.materials[face.material])) continue;
    renderer::Bounds bounds;
    for (const Vec& corner : face.corners) bounds = join(bounds, corner);
    const Vec normal = normalize(eval_area_normal(face.corners));
    const double offset = dot(normal, eval_mean(face.corners));
    pieces.push_back({{face.corners, {normal, offset}}, i, bounds});
    if (!face.two_sided) continue;
    pieces.push_back(
        {{{face.corners.rbegin(), face.corners.rend()}, {-normal, -offset}}, i, bounds});
  }
  return pieces;
}

bool overlap(const renderer::Bounds& a, const renderer::Bounds& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
         a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
}

// Empty corners of the light if it is not above the receiver or the receiver not above it.
Stage make_stage(const Piece& light, const Piece& receiver, std::span<const Piece> faces,
                 double tolerance) {
  Stage stage{light.side, receiver.side, {}, tolerance};
  stage.light.corners = clip(light.side.corners, receiver.side.plane, tolerance);
  if (clip(receiver.side.corners, light.side.plane, tolerance).empty()) stage.light.corners.clear();
  if (stage.light.corners.empty()) return stage;
  const renderer::Bounds space = grow(join(light.bounds, receiver.bounds), tolerance);
  for (const Piece& face : faces) {
    if (face.face == light.face || face.face == receiver.face || !overlap(space, face.bounds))
      continue;
    auto part = clip(face.side.corners, receiver.side.plane, tolerance);
    if (!part.empty()) part = clip(part, light.side.plane, tolerance);
    if (!part.empty()) stage.between.push_back(std::move(part));
  }
  return stage;
}

// Joins the crease with those on the same line that it overlaps or touches; the result is last.
void merge(Crease crease, double same, std::vector<Crease>& creases) {
  for (std::size_t i = 0; i < creases.size();) {
    Crease longer = creases[i], other = crease;
    if (length(longer.b - longer.a) < length(other.b - other.a)) std::swap(longer, other);
    const double size = length(longer.b - longer.a);
    const Vec along = (1 / size) * (longer.b - longer.a);
    const double a = dot(other.a - longer.a, along), b = dot(other.b - longer.a, along);
    const bool on_line = length(longer.a + a * along - other.a) <= same &&
                         length(longer.a + b * along - other.b) <= same;
    if (!on_line || std::max(a, b) < -same || std::min(a, b) > size + same) {
      ++i;
      continue;
    }
    const auto at = [&](double t) { return longer.a + t * along; };
    crease = {std::min(a, b) < 0 ? at(std::min(a, b)) : longer.a,
              std::max(a, b) > size ? at(std::max(a, b)) : longer.b};
    creases.erase(creases.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;
  }
  creases.push_back(crease);
}

}  // namespace

std::vector<Crease> find_creases(const Room& room) {
  renderer::Bounds bounds;
  for (const Face& face : room.faces)
    for (const Vec& corner : face.corners) bounds = join(bounds, corner);
  const double size = max_abs(bounds.hi - bounds.lo);

  const auto lights = find_sides(
      room, [](const Material& m) { return !m.mirror && max_component(m.emission) > 0; });
  const auto receivers = find_sides(
      room, [](const Material& m) { return !m.mirror && max_component(m.reflectance) > 0; });
  auto faces = find_sides(room, [](const Material&) { return true; });
  const auto seconds = std::unique(faces.begin(), faces.end(),
                                   [](const Piece& a, const Piece& b) { return a.face == b.face; });
  faces.erase(seconds, faces.end());

  std::vector<Crease> all, found, merged;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const Piece& receiver = receivers[r];
    for (const Piece& light : lights) {
      if (light.face == receiver.face) continue;
      const Stage stage = make_stage(light, receiver, faces, TOLERANCE * size);
      if (stage.light.corners.empty()) continue;
      add_horizon_crease(stage, found);
      for (std::size_t i = 0; i < stage.between.size(); ++i) add_shadow_creases(stage, i, found);
    }
    // Both sides of a face are one to those who cut it.
    if (r + 1 < receivers.size() && receivers[r + 1].face == receiver.face) continue;
    for (const Crease& crease : found) merge(crease, SAME * size, merged);
    for (const Crease& crease : merged)
      if (length(crease.b - crease.a) > SHORTEST * max_abs(receiver.bounds.hi - receiver.bounds.lo))
        all.push_back(crease);
    found.clear();
    merged.clear();
  }
  return all;
}

}  // namespace radiosity
