#include "renderer/radiosity/creases/stage.hpp"

#include <algorithm>

namespace radiosity {

namespace {

// Offset by which sight lines stay clear of the borders of light and occluder, relative to the
// sizes of light and occluder.
constexpr double ASIDE = 1e-4;
// Smallest height of the light above the occluder, as a multiple of the stage's tolerance. It
// limits the length of shadows.
constexpr double LEAST_FALL = 0.1;

// The sight lines through a point, the apex, to the points of the segment from a to b.
struct Pencil {
  Vec apex, a, b;
};

// Adds to `hidden` the parts of the segment from a to b that a face hides from the apex. The face
// lies between the apex and the segment. With `behind`, the sight lines begin behind the apex, and
// the face may also lie there.
void add_hidden(std::span<const Vec> face, const Vec& apex, const Vec& a, const Vec& b, bool behind,
                std::vector<Interval>& hidden) {
  const Vec u = a - apex, w = b - apex, across = cross(u, w);
  const double square = dot(across, across);
  if (!(square > 0)) return;
  const auto ends = cut(face, make_plane(normalize(across), apex));
  if (!ends) return;
  // p and q are coordinates of a point x in the plane of apex and segment: x - apex = p u + q w.
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

// The parts of the segment that are visible from the apexes of all pencils. All faces hide parts of
// the segment, except face number `except`. The segments of all pencils nearly coincide. `behind`
// is as for add_hidden().
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

// Sight lines in a critical plane. They lead from the light past the border of the occluder to the
// receiver. They either all start at one point of the light or all pass one point of the occluder.
struct Wedge {
  std::array<Vec, 2> from, through;
};

struct Shadow {
  const Stage& stage;
  std::size_t blocker;
  Vec light_mean, blocker_mean, blocker_normal;
  std::vector<Plane> edges;  // planes through the edges of the receiver, perpendicular to it
};

Vec project(const Plane& ground, const Vec& from, const Vec& through) {
  const double high = eval_height(ground, from), low = eval_height(ground, through);
  return from + (high / (high - low)) * (through - from);
}

// Makes pencils slightly beside the wedge: their sight lines begin just inside the light and pass
// just outside the occluder. If all sight lines pass a corner of the occluder, there are two
// pencils, one on either side of the corner. If the occluder continues in another face at this
// corner, the shadow has no corner there, and that face blocks one of the pencils.
std::vector<Pencil> step_aside(const Wedge& wedge, const Shadow& shadow) {
  const Plane& ground = shadow.stage.receiver.plane;
  const bool passes_one = wedge.through[0] == wedge.through[1];
  Vec beside;
  // Offset from the plane of the occluder. Without it, sight lines would meet other faces in that
  // plane only at a point.
  Vec off;
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

// Adds the creases where the wedge's sight lines meet the receiver.
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
  // Drops sight lines along which the occluder is not below the light, as seen from the receiver.
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
  // Converts a fraction of the segment on the receiver to a fraction of the other edge of the
  // wedge: the edge of the light on which sight lines begin, or the edge of the occluder that they
  // pass.
  const double falls[] = {fall(0), fall(1)};
  const auto back = [&](double t) { return t * falls[0] / ((1 - t) * falls[1] + t * falls[0]); };
  shorten({back(inside->from), back(inside->to)});

  const std::vector<Pencil> pencils = step_aside(wedge, shadow);
  const bool passes_one = wedge.through[0] == wedge.through[1];
  const auto seen = find_seen(stage.between, shadow.blocker, pencils, passes_one);
  add_seen(seen, lerp(far[0], far[1], inside->from), lerp(far[0], far[1], inside->to),
           stage.tolerance, creases);
}

// True if the polygon has corners on both sides of the plane, farther from it than the tolerance.
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

// The plane through `corner` and the edge from a to b: a corner of the light and an edge of the
// occluder, or a corner of the occluder and an edge of the light. Returns none if they span no
// plane, if the plane cuts the occluder, or if the light lies in the plane.
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

// Adds the creases caused by the plane in which the occluder lies, if this plane cuts the light.
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

// Adds the creases that the occluder `between[blocker]` causes on the receiver, except where other
// faces hide them from the light. Shadow borders lie on critical planes that cut neither light nor
// occluder. On one side of such a plane, the occluder hides either nothing of the light or as much
// as it can. Further borders lie on the occluder's own plane if this plane cuts the light, and
// where the occluder touches the receiver. If a plane through an edge of the occluder and a corner
// of the light cuts the light, it causes a crease within the penumbra.
void add_shadow_creases(const Stage& stage, std::size_t blocker, StageCreases& found) {
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
      // The plane contains an edge of the light, and does not cut the light, which is convex.
      if (find_plane(stage, face, corner, a, b))
        add_wedge({{a, b}, {corner, corner}}, shadow, found.borders);
    }
  add_own_plane_creases(shadow, found.borders);
}

// Adds the crease where the plane of the light cuts the receiver. The light shines only on one side
// of this line.
void add_horizon_crease(const Stage& stage, std::vector<Crease>& creases) {
  const FaceSide& light = stage.light;
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

}  // namespace

StageCreases find_creases(const Stage& stage) {
  StageCreases found;
  add_horizon_crease(stage, found.borders);
  for (std::size_t i = 0; i < stage.between.size(); ++i) add_shadow_creases(stage, i, found);
  return found;
}

}  // namespace radiosity
