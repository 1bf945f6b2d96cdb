#include "renderer/trace/shadow_rays.hpp"

#include <limits>
#include <span>

#include "renderer/scene/primitives.hpp"

namespace renderer {

namespace {

// Sums of masks. count() converts them to numbers of tests.
struct Counts {
  Mask boxes{}, tests{}, edges{};
};

// The result of eval_epsilon() for each lane.
[[gnu::always_inline]] inline Lanes eval_epsilons(const Scene& scene, const Vecs& origin) {
  const Lanes largest = max(max(abs(origin.x), abs(origin.y)), abs(origin.z));
  return renderer::clamp(SELF_RELATIVE * largest, scene.least_epsilon, scene.epsilon);
}

[[gnu::always_inline]] inline Lanes eval_side(const Line& edge, const Lanes& u, const Lanes& v) {
  return edge.normal_u * u + edge.normal_v * v - edge.offset;
}

[[gnu::always_inline]] inline Lanes find_depths_in_convex(std::span<const PolygonCorner> corners,
                                                          const Lanes& u, const Lanes& v) {
  Lanes least = NO_HIT - Lanes{};
  for (const PolygonCorner& corner : corners) least = min(least, eval_side(corner.edge, u, v));
  return least;
}

[[gnu::always_inline]] inline Lanes find_depths(std::span<const PolygonCorner> corners,
                                                const Lanes& u, const Lanes& v) {
  Mask inside{};
  Lanes nearest = NO_HIT - Lanes{};
  const PolygonCorner* last = &corners.back();
  for (const PolygonCorner& corner : corners) {
    nearest = min(nearest, abs(corner.v - v));
    const Mask rises = corner.v > v, beside = rises ^ (last->v > v);
    const Lanes side = eval_side(last->edge, u, v);
    inside ^= beside & ~((side > 0.0) ^ rises);
    nearest = beside ? min(nearest, abs(side)) : nearest;
    last = &corner;
  }
  return inside ? nearest : -nearest;
}

// True if intersect_closely() finds a hit for the ray of lane `i`.
bool is_met_closely(const Scene& scene, const Polygon& p, const ShadowRays& rays, std::size_t i,
                    double epsilon) {
  const Vec origin{rays.origin.x[i], rays.origin.y[i], rays.origin.z[i]};
  const Vec direction{rays.direction.x[i], rays.direction.y[i], rays.direction.z[i]};
  return intersect_closely(p, scene.corners.data(), origin, direction, epsilon) < rays.reach[i];
}

// The lanes of `here` whose ray is blocked by the polygon: intersect() for each lane.
[[gnu::always_inline]] inline Mask meet(const Scene& scene, const Polygon& p,
                                        const ShadowRays& rays, const Lanes& epsilon,
                                        const Mask& here, Counts& counts) {
  counts.tests += here;
  const Lanes height = p.offset - dot(rays.origin, p.normal);
  const Lanes along = dot(rays.direction, p.normal), distance = height / along;
  const Lanes cosine = abs(along);
  const Lanes error = p.slack + EDGE_MARGIN * epsilon;  // as Polygon::slack + eval_closeness()
  const Mask other = here & (rays.from != static_cast<std::int64_t>(p.tag.object));
  const Mask ahead = other & (distance > epsilon) & (distance < NO_HIT);
  counts.edges += ahead;
  const Mask near = ahead & (distance < rays.reach);
  const Mask edge_on =
      other & (cosine <= (p.shape == Shape::bent ? 2 : EDGE_ON)) & (near | (abs(height) <= error));
  if (!holds_any(near | edge_on)) return near;
  const Lanes u = rays.origin[p.u] + distance * rays.direction[p.u];
  const Lanes v = rays.origin[p.v] + distance * rays.direction[p.v];
  const std::span corners(scene.corners.data() + p.first, p.count);
  const Lanes depth = cosine * (p.shape == Shape::convex ? find_depths_in_convex(corners, u, v)
                                                         : find_depths(corners, u, v));
  const Mask close = edge_on | (near & (depth <= error) & (depth >= -error));
  Mask hit = near & (depth > error) & ~close;
  if (holds_any(close)) [[unlikely]]
    for (std::size_t i = 0; i < LANES; ++i)
      if (close[i]) hit[i] = -is_met_closely(scene, p, rays, i, epsilon[i]);
  return hit;
}

// Slab test of a box in all lanes. The ray of each lane enters the box by the plane that its
// direction meets first.
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

// Traverses the boxes. Each lane has its own next box; it waits while only other lanes need the
// current box. A lane whose ray is blocked needs no further boxes.
[[gnu::always_inline]] inline void block_lanes(const Scene& scene, ShadowRays& rays, Work& work) {
  constexpr std::int64_t NEVER = std::numeric_limits<std::int64_t>::max();
  const Box* boxes = scene.hierarchy.boxes.data();
  const auto end = static_cast<std::int64_t>(scene.hierarchy.boxes.size());
  const Slabs slabs(rays);
  const Lanes epsilon = eval_epsilons(scene, rays.origin);
  Counts counts;
  const Mask never = NEVER - Mask{};
  Mask next = rays.cast ? Mask{} : never;
  for (std::int64_t i = min(next); i < end;) {
    const Box& box = boxes[i];
    const Mask here = next <= i;
    if (box.item != Box::INNER) {
      const Polygon& polygon = scene.polygons[Place{box.item}.index()];
      const Mask hit = meet(scene, polygon, rays, epsilon, here, counts);
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

}  // namespace

void find_blocked(const Scene& scene, ShadowRays& rays, Work& work) {
  run_in_lanes([&]() __attribute__((always_inline)) { block_lanes(scene, rays, work); });
}

}  // namespace renderer
