#include "renderer/progressive/tree_levels.hpp"

namespace renderer::progressive {

TreeRays& TreeRays::operator+=(const TreeRays& other) {
  repeated += other.repeated;
  fresh += other.fresh;
  work += other.work;
  return *this;
}

std::uint32_t deepen(const Scene& scene, const Params& params, int x, int y, int from, int to,
                     Samples& samples, TreeRays& rays, Children& stack) {
  Params asked = params;
  asked.limits.depth = to;
  std::uint32_t seen = NO_OBJECT;
  stack.push_back(make_primary(scene.view, asked, x, y));
  while (!stack.empty()) {
    const Ray ray = stack.back();
    stack.pop_back();
    const auto hit = intersect(scene, ray, asked.traversal, rays.work);
    if (hit && ray.kind == RayKind::primary) seen = hit->object;
    if (ray.level <= from) {
      ++rays.repeated;
      if (hit) make_branches(scene, asked, ray, *hit, stack, rays.work);
    } else {
      rays.fresh.add(ray.kind, hit.has_value());
      samples.add(ray.sample, eval_contribution(scene, asked, ray, hit, rays.work));
      if (hit) make_children(scene, asked, ray, *hit, stack, rays.work);
    }
  }
  return seen;
}

}  // namespace renderer::progressive
