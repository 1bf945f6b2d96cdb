#pragma once
// The walk through a scene along a ray. A header of static functions, so that walks that tell what
// they read are compiled apart from those that do not: the latter stay inlined and pay nothing.

#include <optional>
#include <utility>

#include "renderer/scene/kernels.hpp"
#include "renderer/trace/intersect.hpp"

namespace renderer::walking {

struct Nearest {
  double distance;
  std::uint32_t object = NO_OBJECT;
  Place place;
};

// The state of a walk, and what it counts.
struct Walk {
  const Scene& scene;
  const Ray& ray;
  Nearest best;
  std::uint32_t boxes = 0;
  std::uint32_t tests[4] = {}, roots = 0, edges = 0;
};

[[gnu::always_inline]] inline void count(Walk& walk, Work& work) {
  work[Op::box_test] += std::exchange(walk.boxes, 0);
  work[Op::sphere_test] += std::exchange(walk.tests[0], 0);
  work[Op::polygon_test] += std::exchange(walk.tests[1], 0);
  work[Op::patch_test] += std::exchange(walk.tests[2], 0);
  work[Op::sphere_root] += std::exchange(walk.roots, 0);
  work[Op::polygon_edges] += std::exchange(walk.edges, 0);
  work[Op::cone_test] += std::exchange(walk.tests[3], 0);
}

// The listener of a walk that tells nothing.
struct Nobody {
  static constexpr bool LISTENS = false;
};

// It is inlined into every walk, which saves some 8 % of a rendering.
[[gnu::always_inline]] inline double test(Walk& walk, Place place, Tag& tag) {
  const Scene& scene = walk.scene;
  const Vec &o = walk.ray.origin, &d = walk.ray.direction;
  const auto own = [&](const Tag& t) {
    tag = t;
    return t.object == walk.ray.from;
  };
  switch (place.kind()) {
    case Kind::sphere: {
      const Sphere& s = scene.spheres[place.index()];
      return intersect_sphere(s, o, d, scene.epsilon, own(s.tag), walk.roots);
    }
    case Kind::polygon: {
      const Polygon& p = scene.polygons[place.index()];
      return intersect_polygon(p, scene.corners.data(), o, d, scene.epsilon, own(p.tag),
                               walk.edges);
    }
    case Kind::patch: {
      const Polygon& p = scene.patches[place.index()].flat;
      return intersect_polygon(p, scene.corners.data(), o, d, scene.epsilon, own(p.tag),
                               walk.edges);
    }
    case Kind::cone: {
      const Cone& c = scene.cones[place.index()];
      return intersect_cone(c, o, d, scene.epsilon, own(c.tag));
    }
  }
  return NO_HIT;
}

template <class Told>
[[gnu::always_inline]] inline void consider(Walk& walk, Place place, const Told& told) {
  if constexpr (Told::LISTENS) told.object(walk, place);
  ++walk.tests[static_cast<int>(place.kind())];
  Tag tag;
  const double distance = test(walk, place, tag);
  Nearest& best = walk.best;
  if (distance < best.distance ||
      (distance == best.distance && tag.object < best.object && best.object != NO_OBJECT))
    best = {distance, tag.object, place};
}

template <class Told>
static void walk_linear(Walk& walk, const Told& told) {
  for (const Place place : walk.scene.objects) consider(walk, place, told);
}

// Walks depth first in stored order. CLIP: boxes end at the nearest hit so far; ANY: stop at a hit.
template <bool CLIP, bool ANY, class Told>
static void walk_boxes(Walk& walk, const Told& told) {
  const Box* boxes = walk.scene.hierarchy.boxes.data();
  const auto count = static_cast<std::uint32_t>(walk.scene.hierarchy.boxes.size());
  const Vec o = walk.ray.origin;
  const Vec inverse{1 / walk.ray.direction.x, 1 / walk.ray.direction.y, 1 / walk.ray.direction.z};
  // The corner of every box through whose planes the ray enters, and the other one.
  using Face = const Vec Bounds::*;
  const Face in_x = inverse.x < 0 ? &Bounds::hi : &Bounds::lo;
  const Face in_y = inverse.y < 0 ? &Bounds::hi : &Bounds::lo;
  const Face in_z = inverse.z < 0 ? &Bounds::hi : &Bounds::lo;
  const Face out_x = inverse.x < 0 ? &Bounds::lo : &Bounds::hi;
  const Face out_y = inverse.y < 0 ? &Bounds::lo : &Bounds::hi;
  const Face out_z = inverse.z < 0 ? &Bounds::lo : &Bounds::hi;
  std::uint32_t tested = 0;
  for (std::uint32_t i = 0; i < count;) {
    const Box& box = boxes[i];
    if constexpr (Told::LISTENS) walk.boxes = std::exchange(tested, 0);
    if (box.item != Box::INNER) {
      consider(walk, Place{box.item}, told);
      if (ANY && walk.best.object != NO_OBJECT) break;
      ++i;
      continue;
    }
    if constexpr (Told::LISTENS) told.box(walk, i);
    ++tested;
    // Slabs: from the last entry to the first exit. A NaN (0 * infinity: the ray runs in a face)
    // compares false and leaves the interval as it is.
    double enter = 0, leave = CLIP ? walk.best.distance : NO_HIT;
    const auto clip = [&](double in_plane, double out_plane, double from, double inv) {
      const double in = (in_plane - from) * inv, out = (out_plane - from) * inv;
      enter = in > enter ? in : enter;
      leave = out < leave ? out : leave;
    };
    const Bounds& b = box.bounds;
    clip((b.*in_x).x, (b.*out_x).x, o.x, inverse.x);
    clip((b.*in_y).y, (b.*out_y).y, o.y, inverse.y);
    clip((b.*in_z).z, (b.*out_z).z, o.z, inverse.z);
    i = enter <= leave ? i + 1 : box.skip;
  }
  walk.boxes = tested;
}

// The hit on the nearest object; a feeler's has neither point nor normal.
static Hit make_hit(const Walk& walk) {
  const Scene& scene = walk.scene;
  const Ray& ray = walk.ray;
  const Place place = walk.best.place;
  Hit hit;
  hit.distance = walk.best.distance;
  hit.object = walk.best.object;
  if (ray.kind == RayKind::shadow) return hit;
  hit.point = ray.origin + hit.distance * ray.direction;
  Vec geometric;
  switch (place.kind()) {
    case Kind::sphere:
      hit.surface = scene.spheres[place.index()].tag.surface;
      hit.normal = geometric = eval_normal(scene.spheres[place.index()], hit.point);
      break;
    case Kind::polygon:
      hit.surface = scene.polygons[place.index()].tag.surface;
      hit.normal = geometric = scene.polygons[place.index()].normal;
      break;
    case Kind::patch: {
      const Patch& patch = scene.patches[place.index()];
      hit.surface = patch.flat.tag.surface;
      geometric = patch.flat.normal;
      hit.normal = eval_normal(patch, scene.corners.data(), scene.normals.data(), hit.point);
      // At a silhouette the interpolated normal may be on the other side than the plane's.
      if (dot(hit.normal, ray.direction) * dot(geometric, ray.direction) <= 0)
        hit.normal = geometric;
      break;
    }
    case Kind::cone:
      hit.surface = scene.cones[place.index()].tag.surface;
      hit.normal = geometric = eval_normal(scene.cones[place.index()], hit.point);
      break;
  }
  hit.inside = dot(geometric, ray.direction) > 0;
  if (hit.inside) hit.normal = -hit.normal;
  return hit;
}

template <class Told>
static std::optional<Hit> find(const Scene& scene, const Ray& ray, Traversal traversal, Work& work,
                               const Told& told) {
  Walk walk{scene, ray, {ray.reach, NO_OBJECT, {}}};
  switch (traversal) {
    case Traversal::linear:
      walk_linear(walk, told);
      break;
    case Traversal::exhaustive:
      walk_boxes<false, false>(walk, told);
      break;
    case Traversal::nearest:
      if (ray.kind == RayKind::shadow)
        walk_boxes<true, true>(walk, told);
      else
        walk_boxes<true, false>(walk, told);
      break;
  }
  work[Op::ray_intersected] += 1;
  count(walk, work);
  if (walk.best.object == NO_OBJECT) return std::nullopt;
  work[Op::hit_made] += ray.kind != RayKind::shadow;
  return make_hit(walk);
}

}  // namespace renderer::walking
