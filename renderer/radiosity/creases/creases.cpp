#include "renderer/radiosity/creases/creases.hpp"

#include <algorithm>
#include <functional>
#include <numbers>

#include "renderer/radiosity/creases/stage.hpp"

namespace radiosity {

namespace {

// TOLERANCE is the limit for rounding errors. SAME is the distance up to which two lines count as
// one line. Both are relative to the size of the room.
constexpr double TOLERANCE = 1e-6, SAME = 1e-5;
// Creases shorter than this fraction of their face's size are dropped.
constexpr double SHORTEST = 1e-3;

// One side of a face of the room, with the number of the face.
struct Piece {
  FaceSide side;
  std::size_t face;
  renderer::Bounds bounds;
  double emission;  // largest colour component
};

// The sides of those faces whose materials satisfy `wanted`.
template <typename Wanted>
std::vector<Piece> find_sides(const Room& room, const Wanted& wanted) {
  std::vector<Piece> pieces;
  for (std::size_t i = 0; i < room.faces.size(); ++i) {
    const Face& face = room.faces[i];
    if (!wanted(room.materials[face.material])) continue;
    const auto bounds = renderer::make_bounds(face.corners);
    const Plane front =
        make_plane(normalize(eval_area_normal(face.corners)), eval_mean(face.corners));
    const double emission = max_component(room.materials[face.material].emission);
    pieces.push_back({{face.corners, front}, i, bounds, emission});
    if (!face.two_sided) continue;
    const Plane back{-front.normal, -front.offset};
    pieces.push_back({{{face.corners.rbegin(), face.corners.rend()}, back}, i, bounds, emission});
  }
  return pieces;
}

bool overlap(const renderer::Bounds& a, const renderer::Bounds& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y &&
         a.lo.z <= b.hi.z && b.lo.z <= a.hi.z;
}

// Makes the stage for one light and one receiver. Clips the light to its part above the receiver's
// plane, and other faces to their parts above both planes. The light becomes empty if light and
// receiver do not face each other.
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

// Approximate illumination at the middle of the receiver, without occlusion. Cosines have a lower
// limit, because a light that is seen edge-on from the middle may still shine on other points.
double eval_strength(const Piece& light, const Piece& receiver) {
  constexpr double LEAST_COSINE = 0.1;
  const Vec way = eval_mean(receiver.side.corners) - eval_mean(light.side.corners);
  const double square = dot(way, way), distance = std::sqrt(square);
  if (square == 0) return 0;
  const auto cosine = [&](const Plane& plane, double sign) {
    return std::max(LEAST_COSINE * distance, sign * dot(plane.normal, way));
  };
  const double area = length(eval_area_normal(light.side.corners)) / 2;
  return light.emission * area * cosine(light.side.plane, 1) * cosine(receiver.side.plane, -1) /
         (square * (std::numbers::pi * square + area));
}

// The lights in descending order of eval_strength().
std::vector<const Piece*> sort_by_strength(std::span<const Piece> lights, const Piece& receiver) {
  std::vector<std::pair<double, const Piece*>> sorted;
  for (const Piece& light : lights)
    if (light.face != receiver.face) sorted.emplace_back(eval_strength(light, receiver), &light);
  std::ranges::stable_sort(sorted, std::greater{}, &std::pair<double, const Piece*>::first);
  std::vector<const Piece*> order;
  for (const auto& [strength, light] : sorted) order.push_back(light);
  return order;
}

// A crease with its rank. Ranks are compared first by whether the crease lies within a penumbra,
// then by the number of lights that are stronger than the crease's light.
struct Ranked {
  Crease crease;
  std::pair<bool, std::size_t> rank;
};

// Merges `added` with the creases that overlap or touch it on one line, and appends the result. The
// result gets the lowest rank of the merged creases.
void merge(Ranked added, double same, std::vector<Ranked>& creases) {
  for (std::size_t i = 0; i < creases.size();) {
    Crease longer = creases[i].crease, other = added.crease;
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
    added = {{std::min(a, b) < 0 ? at(std::min(a, b)) : longer.a,
              std::max(a, b) > size ? at(std::max(a, b)) : longer.b},
             std::min(added.rank, creases[i].rank)};
    creases.erase(creases.begin() + static_cast<std::ptrdiff_t>(i));
    i = 0;
  }
  creases.push_back(added);
}

}  // namespace

std::vector<Crease> find_creases(const Room& room) {
  const renderer::Bounds bounds = eval_bounds(room);
  const double size = max_abs(bounds.hi - bounds.lo);

  const auto lights = find_sides(
      room, [](const Material& m) { return !m.mirror && max_component(m.emission) > 0; });
  const auto receivers = find_sides(
      room, [](const Material& m) { return !m.mirror && max_component(m.reflectance) > 0; });
  auto faces = find_sides(room, [](const Material&) { return true; });
  const auto seconds = std::unique(faces.begin(), faces.end(),
                                   [](const Piece& a, const Piece& b) { return a.face == b.face; });
  faces.erase(seconds, faces.end());

  std::vector<Crease> all;
  std::vector<Ranked> merged;
  for (std::size_t r = 0; r < receivers.size(); ++r) {
    const Piece& receiver = receivers[r];
    const auto order = sort_by_strength(lights, receiver);
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
      const Stage stage = make_stage(*order[rank], receiver, faces, TOLERANCE * size);
      if (stage.light.corners.empty()) continue;
      const StageCreases found = find_creases(stage);
      for (const Crease& crease : found.borders)
        merge({crease, {false, rank}}, SAME * size, merged);
      for (const Crease& crease : found.within) merge({crease, {true, rank}}, SAME * size, merged);
    }
    // Creases divide both sides of a two-sided face. The next receiver is the second side of this
    // face: add its creases first.
    if (r + 1 < receivers.size() && receivers[r + 1].face == receiver.face) continue;
    std::ranges::stable_sort(merged, {}, &Ranked::rank);
    for (const auto& [crease, rank] : merged)
      if (length(crease.b - crease.a) > SHORTEST * max_abs(receiver.bounds.hi - receiver.bounds.lo))
        all.push_back(crease);
    merged.clear();
  }
  return all;
}

base::Field<Creases> creases_field() {
  const base::Names<Creases> names = {
      {"file", Creases::file}, {"auto", Creases::found}, {"none", Creases::none}};
  return base::Declare<Creases>::choice(
      "creases", [](auto& c) -> auto& { return c; }, names,
      "lines where patches end: those of the room's file; auto: also borders of penumbrae, lines "
      "inside them, and smaller patches near lights; or none");
}

void choose_creases(Room& room, Creases creases) {
  room.fine_near_lights = room.fine_shadows = creases == Creases::found;
  if (creases == Creases::none) room.creases.clear();
  if (creases != Creases::found) return;
  const auto found = find_creases(room);
  room.creases.insert(room.creases.end(), found.begin(), found.end());
}

}  // namespace radiosity
