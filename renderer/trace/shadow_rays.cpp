#include "renderer/trace/shadow_rays.hpp"

#include <limits>
#include <span>

#include "renderer/scene/primitives.hpp"

namespace renderer {

namespace {

// Work counts, summed over masks.
struct Counts {
  Mask boxes{}, tests{}, edges{};
};

// is_inside() for each lane.
[[gnu::always_inline]] inline Mask find_inside(std::span<const Corner> corners, const Lanes& u,
                                               const Lanes& v) {
  Mask inside{};
  const Corner* last = &corners.back();
  for (const Corner& corner : corners) {
    const bool rises = corner.v > last->v;
    const Corner &a = rises ? *last : corner, &b = rises ? corner : *last;
    const Mask beside = (corner.v > v) ^ (last->v > v);
    inside ^= beside & ((b.u - a.u) * (v - a.v) > (u - a.u) * (b.v - a.v));
    last = &corner;
  }
  return inside;
}

// The rays among `here` that the polygon blocks: intersect() for each lane.
[[gnu::always_inline]] inline Mask meet(const Scene& scene, const Polygon& p,
                                        const ShadowRays& rays, const Mask& here, Counts& counts) {
  counts.tests += here;
  const Lanes distance = (p.offset - dot(rays.origin, p.normal)) / dot(rays.direction, p.normal);
  const Mask ahead = here & (rays.from != static_cast<std::int64_t>(p.tag.object)) &
                     (distance > scene.epsilon) & (distance < NO_HIT);
  counts.edges += ahead;
  const Mask near = ahead & (distance < rays.reach);
  if (!holds_any(near)) return near;
  const Lanes u = rays.origin[p.u] + distance * rays.direction[p.u];
  const Lanes v = rays.origin[p.v] + distance * rays.direction[p.v];
  return near & find_inside({scene.corners.data() + p.first, p.count}, u, v);
}

// Slab test of a box. Each lane enters by the plane that its direction meets first.
struct Slabs {
  explicit Slabs(const ShadowRays& rays) : rays(rays) {
    const Vecs& d = rays.direction;
    inverse = {1.0 / d.x, 1.0 / d.y, 1.0 / d.z};
  }
  [[gnu::always_inline]] Mask meet(const Bounds& box) const {
    Lanes enter{}, leave = rays.reach;
    const auto clip = [&](Lanes Vecs::*lanes, double Vec::*axis) __attribute__((always_inline)) {
      const Lanes& by = inverse.*lanes;
      const Lanes low = (box.lo.*axis - rays.origin.*lanes) * by;
      const Lanes high = (box.hi.*axis - rays.origin.*lanes) * by;
      const Lanes in = by < 0.0 ? high : low, out = by < 0.0 ? low : high;
      enter = in > enter ? in : enter;
      leave = out < leave ? out : leave;
    };
    clip(&Vecs::x, &Vec::x);
    clip(&Vecs::y, &Vec::y);
    clip(&Vecs::z, &Vec::z);
    return enter <= leave;
  }
  const ShadowRays& rays;
  Vecs inverse;
};

// Traverses the boxes. Each lane has its own next box, and waits at boxes that only other lanes
// need. A blocked feeler needs no further boxes.
[[gnu::always_inline]] inline void block_lanes(const Scene& scene, ShadowRays& rays, Work& work) {
  constexpr std::int64_t NEVER = std::numeric_limits<std::int64_t>::max();
  const Box* boxes = scene.hierarchy.boxes.data();
  const auto end = static_cast<std::int64_t>(scene.hierarchy.boxes.size());
  const Slabs slabs(rays);
  Counts counts;
  const Mask never = NEVER - Mask{};
  Mask next = rays.cast ? Mask{} : never;
  for (std::int64_t i = min(next); i < end;) {
    const Box& box = boxes[i];
    const Mask here = next <= i;
    if (box.item != Box::INNER) {
      const Polygon& polygon = scene.polygons[Place{box.item}.index()];
      const Mask hit = meet(scene, polygon, rays, here, counts);
      ++i;
      if (!holds_any(hit)) continue;
      next = hit ? never : next;
      if (!holds_any(next <= i)) i = min(next);
      continue;
    }
    counts.boxes += here;
    const Mask met = here & slabs.meet(box.bounds);
    next = here & ~met ? static_cast<std::int64_t>(box.skip) - Mask{} : next;
    i = holds_any(met) ? i + 1 : box.skip;
  }
  rays.blocked = rays.cast & (next == NEVER);
  work[Op::ray_intersected] += count(rays.cast);
  work[Op::box_test] += count(counts.boxes);
  work[Op::polygon_test] += count(counts.tests);
  work[Op::polygon_edges] += count(counts.edges);
}

TLAB_WIDE_REGISTERS
void block_wide(const Scene& scene, ShadowRays& rays, Work& work) {
  block_lanes(scene, rays, work);
}

}  // namespace

void find_blocked(const Scene& scene, ShadowRays& rays, Work& work) {
  block_wide(scene, rays, work);
}

}  // namespace renderer
