#include "renderer/trace/intersect.hpp"

#include <utility>

namespace renderer {

namespace {

struct Nearest {
  std::uint32_t object = NO_OBJECT;
  Place place;
  bool is_close = false;  // the hit is close to an edge (see Probe)
};

// State of a traversal, with the counts of its tests.
struct Walk {
  // (There is a constructor because GCC fills fields missing in an initialiser list with a slow
  // instruction.)
  Walk(const Scene& scene, const Ray& ray)
      : scene(scene), ray(ray), probe{ray.origin, ray.direction,
                                      ray.from,   eval_epsilon(scene, ray.origin, ray.travelled),
                                      ray.reach,  scene.corners.data(),
                                      0} {
    probe.closeness = eval_closeness(probe.epsilon);
  }

  const Scene& scene;
  const Ray& ray;
  Nearest best;
  Probe probe;  // `probe.reach` is the distance of the nearest hit so far
  std::uint32_t boxes = 0;
  std::uint32_t tests[4] = {};  // by Kind: number of tests
};

[[gnu::always_inline]] inline void take_counts(Walk& walk, Work& work) {
  constexpr Op TESTS[] = {Op::sphere_test, Op::polygon_test, Op::patch_test, Op::cone_test};
  work[Op::box_test] += std::exchange(walk.boxes, 0);
  for (int kind = 0; kind < 4; ++kind) work[TESTS[kind]] += std::exchange(walk.tests[kind], 0);
  work[Op::sphere_root] += std::exchange(walk.probe.roots, 0);
  work[Op::polygon_edges] += std::exchange(walk.probe.edges, 0);
}

// An access callback that does nothing.
struct NoListener {
  static constexpr bool LISTENS = false;
};

// An access callback that reports each read, together with the counts so far.
struct AccessListener {
  static constexpr bool LISTENS = true;
  Access& access;
  Work& work;

  void box(Walk& walk, std::uint32_t index) const {
    take_counts(walk, work);
    access.box(index, work);
  }
  void object(Walk& walk, Place place) const {
    take_counts(walk, work);
    access.object(place, work);
  }
};

// Tests a moving primitive at the time of the ray. Moves the ray instead of the primitive.
template <class Primitive>
[[gnu::always_inline]] inline double intersect_moved(const Primitive& primitive, Walk& walk) {
  const Vec shift = eval_shift(walk.scene, primitive.tag.object, walk.ray.time);
  const Vec origin = walk.ray.origin - shift;
  Probe probe{origin,
              walk.ray.direction,
              walk.probe.from,
              walk.probe.epsilon,
              walk.probe.reach,
              walk.probe.corners,
              eval_closeness(walk.probe.epsilon, shift)};
  const double distance = intersect(primitive, probe);
  walk.probe.roots += probe.roots;
  walk.probe.edges += probe.edges;
  walk.probe.is_close = probe.is_close;
  return distance;
}

// Tests the primitive at `place`. MOVES is true if objects of the scene move.
template <bool MOVES, class Listener>
[[gnu::always_inline]] inline void consider(Walk& walk, Place place, const Listener& listener) {
  if constexpr (Listener::LISTENS) listener.object(walk, place);
  ++walk.tests[static_cast<int>(place.kind())];
  walk.probe.is_close = false;
  Tag tag;
  const double distance = visit(
      walk.scene, place, [&](const auto& primitive) __attribute__((always_inline)) {
        tag = primitive.tag;
        if constexpr (MOVES)
          return intersect_moved(primitive, walk);
        else
          return intersect(primitive, walk.probe);
      });
  Nearest& best = walk.best;
  double& reach = walk.probe.reach;
  if (distance < reach ||
      (distance == reach && tag.object < best.object && best.object != NO_OBJECT)) {
    reach = distance;
    best = {tag.object, place, walk.probe.is_close};
  }
}

template <bool MOVES, class Listener>
void walk_linear(Walk& walk, const Listener& listener) {
  for (const Place place : walk.scene.objects) consider<MOVES>(walk, place, listener);
}

// Traverses the boxes depth first, in stored order. With CLIP, skips boxes beyond the nearest hit
// so far. With ANY, stops at any hit. MOVES is true if objects of the scene move.
template <bool CLIP, bool ANY, bool MOVES, class Listener>
void walk_boxes(Walk& walk, const Listener& listener) {
  const Box* boxes = walk.scene.hierarchy.boxes.data();
  [[maybe_unused]] const Bounds* moves = walk.scene.hierarchy.moves.data();
  [[maybe_unused]] const double time = walk.ray.time;
  const auto count = static_cast<std::uint32_t>(walk.scene.hierarchy.boxes.size());
  const Vec o = walk.ray.origin;
  const Vec inverse{1 / walk.ray.direction.x, 1 / walk.ray.direction.y, 1 / walk.ray.direction.z};
  // The ray enters every box through the three planes at one corner, and leaves it through the
  // planes at the opposite corner.
  using Face = const Vec Bounds::*;
  const Face in_x = inverse.x < 0 ? &Bounds::hi : &Bounds::lo;
  const Face in_y = inverse.y < 0 ? &Bounds::hi : &Bounds::lo;
  const Face in_z = inverse.z < 0 ? &Bounds::hi : &Bounds::lo;
  const Face out_x = inverse.x < 0 ? &Bounds::lo : &Bounds::hi;
  const Face out_y = inverse.y < 0 ? &Bounds::lo : &Bounds::hi;
  const Face out_z = inverse.z < 0 ? &Bounds::lo : &Bounds::hi;
  double begin = 0;
  // Hides the 0 from GCC, which would otherwise compute the first maximum by a branch.
  asm("" : "+m"(begin));
  std::uint32_t tested = 0;
  for (std::uint32_t i = 0; i < count;) {
    const Box& box = boxes[i];
    if constexpr (Listener::LISTENS) walk.boxes = std::exchange(tested, 0);
    if (box.item != Box::INNER) {
      consider<MOVES>(walk, Place{box.item}, listener);
      if (ANY && walk.best.object != NO_OBJECT) break;
      ++i;
      continue;
    }
    if constexpr (Listener::LISTENS) listener.box(walk, i);
    ++tested;
    // Slab test: the ray is in the box from its last entry to its first exit. A NaN (0 * infinity,
    // if the ray runs in a face of the box) compares as false and leaves the interval unchanged.
    double enter = begin, leave = CLIP ? walk.probe.reach : NO_HIT;
    const auto clip = [&](Face in_face, Face out_face, double Vec::*axis) {
      double in_plane = (box.bounds.*in_face).*axis, out_plane = (box.bounds.*out_face).*axis;
      if constexpr (MOVES) {
        in_plane += time * ((moves[i].*in_face).*axis);
        out_plane += time * ((moves[i].*out_face).*axis);
      }
      const double in = (in_plane - o.*axis) * (inverse.*axis);
      const double out = (out_plane - o.*axis) * (inverse.*axis);
      enter = in > enter ? in : enter;
      leave = out < leave ? out : leave;
    };
    clip(in_x, out_x, &Vec::x);
    clip(in_y, out_y, &Vec::y);
    clip(in_z, out_z, &Vec::z);
    i = enter <= leave ? i + 1 : box.skip;
  }
  walk.boxes = tested;
}

// Calls pull_inside() for polygons. Other primitives have no edges.
Vec pull_from_edges(const Scene& scene, Place place, const Vec& point, double epsilon) {
  return visit(scene, place, [&](const auto& primitive) {
    if constexpr (requires { primitive.count; })
      return pull_inside(primitive, scene.corners.data(), point, epsilon);
    else
      return point;
  });
}

// Makes the hit on the nearest object. For a shadow feeler (ray to a light), omits point and
// normal. Inlined, because a call with `walk` as an argument would force its counts into memory.
template <bool MOVES>
[[gnu::always_inline]] inline void fill_hit(const Walk& walk, Hit& hit) {
  const Scene& scene = walk.scene;
  const Ray& ray = walk.ray;
  const Place place = walk.best.place;
  hit.distance = walk.probe.reach;
  hit.object = walk.best.object;
  if (ray.kind == RayKind::shadow) return;
  hit.point = ray.origin + hit.distance * ray.direction;
  Vec still = hit.point;  // the position of the hit point when the shutter opened
  if constexpr (MOVES) still = hit.point - eval_shift(scene, hit.object, ray.time);
  const Vec geometric = visit(scene, place, [&](const auto& primitive) {
    hit.surface = primitive.tag.surface;
    return eval_normal(primitive, still);
  });
  hit.normal = geometric;
  if (place.kind() == Kind::patch) {
    const Vec smooth =
        eval_smooth_normal(scene.patches[place.index()], scene.corners, scene.normals, still);
    // Near the outline of an object, the interpolated normal may face away from the ray although
    // the normal of the plane does not. The interpolated normal is then turned until it just faces
    // the ray.
    const double along = dot(smooth, ray.direction);
    if (along * dot(geometric, ray.direction) > 0)
      hit.normal = smooth;
    else if (const Vec turned = smooth - (1 + 1e-9) * along * ray.direction; length(turned) > 0.1)
      hit.normal = normalize(turned);
  }
  hit.inside = dot(geometric, ray.direction) > 0;
  if (hit.inside) hit.normal = -hit.normal;
  if (walk.best.is_close) [[unlikely]]
    hit.point += pull_from_edges(scene, place, still,
                                 eval_epsilon(scene, hit.point, ray.travelled + hit.distance)) -
                 still;
}

// Returns the result of the traversal and adds its counts to `work`.
template <bool MOVES>
[[gnu::always_inline]] inline std::optional<Hit> conclude(Walk& walk, Work& work) {
  take_counts(walk, work);
  std::optional<Hit> hit;
  if (walk.best.object == NO_OBJECT) return hit;
  work[Op::hit_made] += walk.ray.kind != RayKind::shadow;
  fill_hit<MOVES>(walk, hit.emplace());
  return hit;
}

template <bool MOVES, class Listener>
std::optional<Hit> find(const Scene& scene, const Ray& ray, Traversal traversal, Work& work,
                        const Listener& listener) {
  Walk walk(scene, ray);
  switch (traversal) {
    case Traversal::linear:
      walk_linear<MOVES>(walk, listener);
      break;
    case Traversal::exhaustive:
      walk_boxes<false, false, MOVES>(walk, listener);
      break;
    case Traversal::nearest:
      if (ray.kind == RayKind::shadow)
        walk_boxes<true, true, MOVES>(walk, listener);
      else
        walk_boxes<true, false, MOVES>(walk, listener);
      break;
  }
  work[Op::ray_intersected] += 1;
  return conclude<MOVES>(walk, work);
}

template <class Listener>
std::optional<Hit> choose(const Scene& scene, const Ray& ray, Traversal traversal, Work& work,
                          const Listener& listener) {
  return scene.moves.empty() ? find<false>(scene, ray, traversal, work, listener)
                             : find<true>(scene, ray, traversal, work, listener);
}

template <bool MOVES>
std::optional<Hit> find_on(const Scene& scene, const Ray& ray, Place place, Work& work) {
  Walk walk(scene, ray);
  consider<MOVES>(walk, place, NoListener{});
  return conclude<MOVES>(walk, work);
}

}  // namespace

std::optional<Hit> intersect(const Scene& scene, const Ray& ray, Traversal traversal, Work& work,
                             Access* access) {
  return access ? choose(scene, ray, traversal, work, AccessListener{*access, work})
                : choose(scene, ray, traversal, work, NoListener{});
}

std::optional<Hit> intersect_object(const Scene& scene, const Ray& ray, Place place, Work& work) {
  return scene.moves.empty() ? find_on<false>(scene, ray, place, work)
                             : find_on<true>(scene, ray, place, work);
}

}  // namespace renderer
