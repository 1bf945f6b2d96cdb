#include "renderer/radiosity/creases/critical.hpp"

#include "renderer/radiosity/creases/sights.hpp"

namespace radiosity {

namespace {

// Sights are drawn so much aside, as a share of light and blocker, that they touch neither.
constexpr double ASIDE = 1e-4;
// Reach of shadows: light must fall at least by so many tolerances from light to blocker.
constexpr double LEAST_FALL = 0.1;

// Sights in a critical plane: from the light, through a point of the blocker's border, to the
// receiver. Either all start at one point or all pass one.
struct Wedge {
  std::array<Vec, 2> from, through;
};

struct Shadow {
  const Stage& stage;
  std::size_t blocker;
  Vec light_mean, blocker_mean, blocker_normal;
  std::vector<Plane> edges;  // of the receiver
  std::vector<Crease>& creases;
};

Vec project(const Plane& ground, const Vec& from, const Vec& through) {
  const double high = eval_height(ground, from), low = eval_height(ground, through);
  return from + (high / (high - low)) * (through - from);
}

// A little aside of the wedge: from the light inside its border, past the blocker. Where all pass
// one corner of the blocker, on both sides of it along the wedge's plane: another face that goes on
// there makes it no corner.
std::vector<Pencil> step_aside(const Wedge& wedge, const Shadow& shadow) {
  const Plane& ground = shadow.stage.receiver.plane;
  const bool passes_one = wedge.through[0] == wedge.through[1];
  Vec beside, off;  // off the blocker's plane, or sights would pass a face in it at one point only
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

void add_seen(const std::vector<Interval>& seen, const Vec& a, const Vec& b, Shadow& shadow) {
  for (const Interval& part : seen) {
    const Crease crease{lerp(a, b, part.from), lerp(a, b, part.to)};
    if (max_abs(crease.b - crease.a) > shadow.stage.tolerance) shadow.creases.push_back(crease);
  }
}

// Where the wedge meets the receiver.
void add_wedge(Wedge wedge, Shadow& shadow) {
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
  if (above[0] < 0) falling.from = above[0] / (above[0] - above[1]);
  if (above[1] < 0) falling.to = above[0] / (above[0] - above[1]);
  shorten(falling);

  const Vec far[] = {project(ground, wedge.from[0], wedge.through[0]),
                     project(ground, wedge.from[1], wedge.through[1])};
  const auto inside = clip_segment(far[0], far[1], shadow.edges, stage.tolerance);
  if (!inside) return;
  // From a share of the way on the receiver back to one on the edge.
  const double falls[] = {fall(0), fall(1)};
  const auto back = [&](double t) { return t * falls[0] / ((1 - t) * falls[1] + t * falls[0]); };
  shorten({back(inside->from), back(inside->to)});

  const std::vector<Pencil> pencils = step_aside(wedge, shadow);
  const bool passes_one = wedge.through[0] == wedge.through[1];
  const auto seen = find_seen(stage.between, shadow.blocker, pencils, passes_one);
  add_seen(seen, lerp(far[0], far[1], inside->from), lerp(far[0], far[1], inside->to), shadow);
}

// Whether a plane cuts a polygon: corners on both sides.
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
  for (const Vec& corner : polygon)
    if (std::abs(eval_height(plane, corner)) > tolerance) return false;
  return true;
}

// Through a corner of one polygon and an edge of the other, if it cuts neither of them.
bool is_critical(const Stage& stage, std::span<const Vec> blocker, const Vec& corner, const Vec& a,
                 const Vec& b) {
  const double tolerance = stage.tolerance;
  const Vec across = cross(b - a, corner - a);
  if (length(across) <= tolerance * length(b - a)) return false;
  const Vec normal = normalize(across);
  const Plane plane{normal, dot(normal, corner)};
  return !contains(plane, stage.light.corners, 10 * tolerance) &&
         length(cross(normal, stage.light.plane.normal)) > ASIDE &&
         !cuts(plane, stage.light.corners, tolerance) && !cuts(plane, blocker, tolerance);
}

}  // namespace

void add_shadow_creases(const Stage& stage, std::size_t blocker, std::vector<Crease>& creases) {
  const auto& light = stage.light.corners;
  const auto& face = stage.between[blocker];
  const auto next = [](const std::vector<Vec>& polygon, std::size_t i) {
    return polygon[(i + 1) % polygon.size()];
  };
  Shadow shadow{stage,
                blocker,
                eval_mean(light),
                eval_mean(face),
                normalize(eval_area_normal(face)),
                make_edge_planes(stage.receiver.corners, stage.receiver.plane.normal),
                creases};
  const auto touches = [&](const Vec& p) {
    return std::abs(eval_height(stage.receiver.plane, p)) <= stage.tolerance;
  };
  for (const Vec& corner : light)
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Vec a = face[i], b = next(face, i);
      if ((touches(a) && touches(b)) || is_critical(stage, face, corner, a, b))
        add_wedge({{corner, corner}, {a, b}}, shadow);
    }
  for (const Vec& corner : face)
    for (std::size_t i = 0; i < light.size(); ++i) {
      const Vec a = light[i], b = next(light, i);
      if (is_critical(stage, face, corner, a, b)) add_wedge({{a, b}, {corner, corner}}, shadow);
    }

  const Plane own{shadow.blocker_normal, dot(shadow.blocker_normal, shadow.blocker_mean)};
  if (!cuts(own, light, stage.tolerance)) return;
  const auto ends = cut(light, own);
  if (!ends) return;
  for (std::size_t i = 0; i < face.size(); ++i) {
    for (const Vec& end : *ends) add_wedge({{end, end}, {face[i], next(face, i)}}, shadow);
    add_wedge({*ends, {face[i], face[i]}}, shadow);
  }
}

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
  Shadow shadow{stage, nobody, mean, mean, light.plane.normal, edges, creases};
  const Vec from = lerp(a, b, inside->from), to = lerp(a, b, inside->to);
  for (const Vec& corner : light.corners) {
    const Vec apex = lerp(corner, mean, ASIDE);
    const Vec aside = ASIDE * length(mean - corner) * light.plane.normal;
    const Pencil pencil{apex + aside, from + aside, to + aside};
    add_seen(find_seen(stage.between, nobody, std::array{pencil}, false), from, to, shadow);
  }
}

}  // namespace radiosity
