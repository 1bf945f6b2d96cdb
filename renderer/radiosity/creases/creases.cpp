#include "renderer/radiosity/creases/creases.hpp"

#include <algorithm>
#include <functional>
#include <numbers>

#include "renderer/radiosity/room/planar.hpp"

namespace radiosity {

namespace {

// Shares of the room's size: what is rounding, and what is one line.
constexpr double TOLERANCE = 1e-6, SAME = 1e-5;
// Creases shorter than this share of their face are left out.
constexpr double SHORTEST = 1e-3;
// Sights pass light and blocker at this distance, a share of their sizes, so that they touch
// neither.
constexpr double ASIDE = 1e-4;
// Least height by which light must fall from light to blocker, in tolerances: it limits how far
// shadows reach.
constexpr double LEAST_FALL = 0.1;

// A side of a face that light leaves or reaches.
struct Side {
  std::vector<Vec> corners;  // counter-clockwise
  Plane plane;               // the side is above
};

// One light, one receiver and what is between them.
struct Stage {
  Side light;  // the part above the receiver
  Side receiver;
  std::vector<std::vector<Vec>> between;  // the parts of other faces that are above both
  double tolerance = 0;                   // lengths below are rounding
};

// Sights through a point to the way from a to b.
struct Pencil {
  Vec apex, a, b;
};

// Adds the parts of the way from a to b, both beyond the apex, that a face hides from sights
// through the apex: it lies between the apex and the way or, if they come from `behind`, before the
// apex.
void add_hidden(std::span<const Vec> face, const Vec& apex, const Vec& a, const Vec& b, bool behind,
                std::vector<Interval>& hidden) {
  const Vec u = a - apex, w = b - apex, across = cross(u, w);
  const double square = dot(across, across);
  if (!(square > 0)) return;
  const auto ends = cut(face, make_plane(normalize(across), apex));
  if (!ends) return;
  // x - apex = p u + q w
  double p[2], q[2];
  for (int i = 0; i < 2; ++i) {
    const Vec x = (*ends)[i] - apex;
    p[i] = dot(cross(x, w), across) / square;
    q[i] = dot(cross(u, x), across) / square;
  }
  for (const double sign : {1.0, -1.0}) {
    if (sign < 0 && !behind) break;
    Interval inside;
    if (!inside.keep_positive(sign * p[0], sign * p[1]) ||
        !inside.keep_positive(sign * q[0], sign * q[1]) || !(inside.from < inside.to))
      continue;
    const auto share = [&](double s) {
      const double beside = p[0] + s * (p[1] - p[0]), along = q[0] + s * (q[1] - q[0]);
      return std::clamp(along / (along + beside), 0.0, 1.0);
    };
    const double one = share(inside.from), other = share(inside.to);
    if (one != other) hidden.push_back({std::min(one, other), std::max(one, other)});
  }
}

// The parts of the way that every pencil reaches past all faces except one; the pencils' ways are
// almost the same. Sights begin at the apex or, if they come from `behind` it, before.
std::vector<Interval> find_seen(std::span<const std::vector<Vec>> faces, std::size_t except,
                                std::span<const Pencil> pencils, bool behind) {
  std::vector<Interval> hidden, seen;
  for (const auto& [apex, a, b] : pencils)
    for (std::size_t i = 0; i < faces.size(); ++i)
      if (i != except) add_hidden(faces[i], apex, a, b, behind, hidden);
  std::ranges::sort(hidden, {}, &Interval::from);
  double reached = 0;
  for (const Interval& part : hidden) {
    if (part.from > reached) seen.push_back({reached, part.from});
    reached = std::max(reached, part.to);
  }
  if (reached < 1) seen.push_back({reached, 1});
  return seen;
}

// Sights in a critical plane: from the light, through a point of the blocker's border, to the
// receiver. Either all start at one point or all pass one.
struct Wedge {
  std::array<Vec, 2> from, through;
};

// Creases on a receiver.
struct Found {
  std::vector<Crease> borders;  // of penumbrae and umbrae
  std::vector<Crease> within;   // a penumbra: another corner of the light comes into sight
};

struct Shadow {
  const Stage& stage;
  std::size_t blocker;
  Vec light_mean, blocker_mean, blocker_normal;
  std::vector<Plane> edges;  // of the receiver
};

Vec project(const Plane& ground, const Vec& from, const Vec& through) {
  const double high = eval_height(ground, from), low = eval_height(ground, through);
  return from + (high / (high - low)) * (through - from);
}

// Pencils a little aside of the wedge: from the light inside its border, past the blocker. Where
// all sights pass one corner of the blocker, there is one on either side of it along the wedge's
// plane: where another face continues the blocker, it has no corner.
std::vector<Pencil> step_aside(const Wedge& wedge, const Shadow& shadow) {
  const Plane& ground = shadow.stage.receiver.plane;
  const bool passes_one = wedge.through[0] == wedge.through[1];
  Vec beside;
  Vec off;  // off the blocker's plane: within it sights would pass a face at one point only
  if (passes_one) {
    off = 0.1 * ASIDE * (lerp(wedge.from[0], wedge.from[1], 0.5) - wedge.through[0]);
    const Vec plane = cross(wedge.from[1] - wedge.from[0], wedge.through[0] - wedge.from[0]);
    const Vec trace = cross(plane, shadow.blocker_normal);
    if (dot(trace, trace) > ASIDE * ASIDE * dot(plane, plane))
      beside = length(wedge.through[0] - shadow.blocker_mean) * normalize(trace);
  }
  std::vector<Pencil> pencils;
  for (const double side : {10 * ASIDE, -10 * ASIDE}) {
    Vec from[2], to[2], through[2];
    for (int i = 0; i < 2; ++i) {
      from[i] = lerp(wedge.from[i], shadow.light_mean, ASIDE);
      through[i] = lerp(wedge.through[i], shadow.blocker_mean, -0.1 * ASIDE) + side * beside + off;
      if (eval_height(ground, from[i]) <= eval_height(ground, through[i])) return pencils;
      to[i] = project(ground, from[i], through[i]);
    }
    pencils.push_back({passes_one ? through[0] : from[0], to[0], to[1]});
    if (!passes_one) break;
  }
  return pencils;
}

void add_seen(const std::vector<Interval>& seen, const Vec& a, const Vec& b, double tolerance,
              std::vector<Crease>& creases) {
  for (const Interval& part : seen) {
    const Crease crease{lerp(a, b, part.from), lerp(a, b, part.to)};
    if (max_abs(crease.b - crease.a) > tolerance) creases.push_back(crease);
  }
}

// Adds the creases along which the wedge meets the receiver.
void add_wedge(Wedge wedge, const Shadow& shadow, std::vector<Crease>& creases) {
  const Stage& stage = shadow.stage;
  const Plane& ground = stage.receiver.plane;
  const auto fall = [&](int i) {
    return eval_height(ground, wedge.from[i]) - eval_height(ground, wedge.through[i]);
  };
  const auto shorten = [&](const Interval& part) {
    const Wedge whole = wedge;
    const double ends[] = {part.from, part.to};
    for (int i = 0; i < 2; ++i) {
      wedge.from[i] = lerp(whole.from[0], whole.from[1], ends[i]);
      wedge.through[i] = lerp(whole.through[0], whole.through[1], ends[i]);
    }
  };
  // Only light that falls reaches the receiver.
  const double least = LEAST_FALL * stage.tolerance;
  Interval falling;
  const double above[] = {fall(0) - least, fall(1) - least};
  if (above[0] <= 0 && above[1] <= 0) return;
  falling.keep_positive(above[0], above[1]);
  shorten(falling);

  const Vec far[] = {project(ground, wedge.from[0], wedge.through[0]),
                     project(ground, wedge.from[1], wedge.through[1])};
  const auto inside = clip_segment(far[0], far[1], shadow.edges, stage.tolerance);
  if (!inside) return;
  // The share on the edge that belongs to a share of the way on the receiver.
  const double falls[] = {fall(0), fall(1)};
  const auto back = [&](double t) { return t * falls[0] / ((1 - t) * falls[1] + t * falls[0]); };
  shorten({back(inside->from), back(inside->to)});

  const std::vector<Pencil> pencils = step_aside(wedge, shadow);
  const bool passes_one = wedge.through[0] == wedge.through[1];
  const auto seen = find_seen(stage.between, shadow.blocker, pencils, passes_one);
  add_seen(seen, lerp(far[0], far[1], inside->from), lerp(far[0], far[1], inside->to),
           stage.tolerance, creases);
}

// Whether the polygon has corners on both sides of the plane.
bool cuts(const Plane& plane, std::span<const Vec> polygon, double tolerance) {
  bool above = false, below = false;
  for (const Vec& corner : polygon) {
    const double height = eval_height(plane, corner);
    above = above || height > tolerance;
    below = below || height < -tolerance;
  }
  return above && below;
}

bool contains(const Plane& plane, std::span<const Vec> polygon, double tolerance) {
  return std::ranges::all_of(polygon, [&](const Vec& corner) {
    return std::abs(eval_height(plane, corner)) <= tolerance;
  });
}

// The plane through a corner and an edge, one of the light and one of the blocker. Nothing if there
// is none, if it cuts the blocker, or if the light lies in it.
std::optional<Plane> find_plane(const Stage& stage, std::span<const Vec> blocker, const Vec& corner,
                                const Vec& a, const Vec& b) {
  const double tolerance = stage.tolerance;
  const Vec across = cross(b - a, corner - a);
  if (length(across) <= tolerance * length(b - a)) return std::nullopt;
  const Plane plane = make_plane(normalize(across), corner);
  if (contains(plane, stage.light.corners, 10 * tolerance) ||
      length(cross(plane.normal, stage.light.plane.normal)) <= ASIDE ||
      cuts(plane, blocker, tolerance))
    return std::nullopt;
  return plane;
}

// Adds the creases where the blocker's own plane, if it cuts the light, meets the receiver.
void add_own_plane_creases(const Shadow& shadow, std::vector<Crease>& creases) {
  const auto& light = shadow.stage.light.corners;
  const auto& face = shadow.stage.between[shadow.blocker];
  const Plane own = make_plane(shadow.blocker_normal, shadow.blocker_mean);
  if (!cuts(own, light, shadow.stage.tolerance)) return;
  const auto ends = cut(light, own);
  if (!ends) return;
  for (std::size_t i = 0; i < face.size(); ++i) {
    for (const Vec& end : *ends)
      add_wedge({{end, end}, {face[i], face[(i + 1) % face.size()]}}, shadow, creases);
    add_wedge({*ends, {face[i], face[i]}}, shadow, creases);
  }
}

// Adds the creases that between[blocker] makes on the receiver. The borders lie where the planes
// through an edge of light or blocker and a corner of the other that cut neither (on one side of
// such a plane the blocker hides nothing of the light, or all it can) meet the receiver; where the
// blocker's own plane does, if it cuts the light; and where the blocker touches the receiver.
// Where the plane through an edge of the blocker and a corner cuts the light, the crease is within
// the penumbra. Only what no other face hides from the light counts.
void add_shadow_creases(const Stage& stage, std::size_t blocker, Found& found) {
  const auto& light = stage.light.corners;
  const auto& face = stage.between[blocker];
  const auto next = [](const std::vector<Vec>& polygon, std::size_t i) {
    return polygon[(i + 1) % polygon.size()];
  };
  const Shadow shadow{stage,
                      blocker,
                      eval_mean(light),
                      eval_mean(face),
                      normalize(eval_area_normal(face)),
                      make_edge_planes(stage.receiver.corners, stage.receiver.plane.normal)};
  const auto touches = [&](const Vec& p) {
    return std::abs(eval_height(stage.receiver.plane, p)) <= stage.tolerance;
  };
  for (const Vec& corner : light)
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Vec a = face[i], b = next(face, i);
      const bool is_contact = touches(a) && touches(b);
      const auto plane = find_plane(stage, face, corner, a, b);
      if (!is_contact && !plane) continue;
      const bool is_within = !is_contact && cuts(*plane, light, stage.tolerance);
      add_wedge({{corner, corner}, {a, b}}, shadow, is_within ? found.within : found.borders);
    }
  for (const Vec& corner : face)
    for (std::size_t i = 0; i < light.size(); ++i) {
      const Vec a = light[i], b = next(light, i);
      if (find_plane(stage, face, corner, a, b))  // it does not cut the light, which is convex
        add_wedge({{a, b}, {corner, corner}}, shadow, found.borders);
    }
  add_own_plane_creases(shadow, found.borders);
}

// Adds the crease where the light's own plane cuts the receiver: it shines on one side only.
void add_horizon_crease(const Stage& stage, std::vector<Crease>& creases) {
  const Side& light = stage.light;
  if (!cuts(light.plane, stage.receiver.corners, stage.tolerance)) return;
  const auto ends = cut(stage.receiver.corners, light.plane);
  if (!ends) return;
  const std::size_t nobody = stage.between.size();
  const Vec mean = eval_mean(light.corners);
  const std::vector<Plane> edges =
      make_edge_planes(stage.receiver.corners, stage.receiver.plane.normal);
  const auto [a, b] = *ends;
  const auto inside = clip_segment(a, b, edges, stage.tolerance);
  if (!inside) return;
  const Vec from = lerp(a, b, inside->from), to = lerp(a, b, inside->to);
  for (const Vec& corner : light.corners) {
    const Vec apex = lerp(corner, mean, ASIDE);
    const Vec aside = ASIDE * length(mean - corner) * light.plane.normal;
    const Pencil pencil{apex + aside, from + aside, to + aside};
    add_seen(find_seen(stage.between, nobody, std::array{pencil}, false), from, to, stage.tolerance,
             creases);
  }
}

// A side of a face, with the number of the face.
struct Piece {
  Side side;
  std::size_t face;
  renderer::Bounds bounds;
  double emission;  // the largest of the three
};

// The sides of the faces of wanted materials.
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

// The light has no corners if it is not above the receiver or the receiver not above it.
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

// About how bright a light makes the middle of a receiver if nothing is between. Either may be seen
// from its edge there and not elsewhere.
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

// The lights in the order of their strength on the receiver.
std::vector<const Piece*> sort_by_strength(std::span<const Piece> lights, const Piece& receiver) {
  std::vector<std::pair<double, const Piece*>> sorted;
  for (const Piece& light : lights)
    if (light.face != receiver.face) sorted.emplace_back(eval_strength(light, receiver), &light);
  std::ranges::stable_sort(sorted, std::greater{}, &std::pair<double, const Piece*>::first);
  std::vector<const Piece*> order;
  for (const auto& [strength, light] : sorted) order.push_back(light);
  return order;
}

// A crease; whether it lies within a penumbra, and how many lights are stronger than the one that
// makes it.
struct Ranked {
  Crease crease;
  std::pair<bool, std::size_t> rank;
};

// Joins the crease with those on the same line that it overlaps or touches; the result is last, and
// has the rank of the strongest.
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
      Found found;
      add_horizon_crease(stage, found.borders);
      for (std::size_t i = 0; i < stage.between.size(); ++i) add_shadow_creases(stage, i, found);
      for (const Crease& crease : found.borders)
        merge({crease, {false, rank}}, SAME * size, merged);
      for (const Crease& crease : found.within) merge({crease, {true, rank}}, SAME * size, merged);
    }
    // The creases of both sides of a face cut it.
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
      "creases", [](Creases & c) -> auto& { return c; }, names,
      "lines at which patches end: the room's; these and the borders of penumbrae and lines within "
      "them that are found, and near lights smaller patches; none");
}

void choose_creases(Room& room, Creases creases) {
  if (creases == Creases::none) room.creases.clear();
  if (creases != Creases::found) return;
  const auto found = find_creases(room);
  room.creases.insert(room.creases.end(), found.begin(), found.end());
  room.fine_near_lights = true;
}

}  // namespace radiosity
