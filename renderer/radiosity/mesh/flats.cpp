#include "renderer/radiosity/mesh/flats.hpp"

#include <algorithm>
#include <cmath>
#include <ranges>

#include "renderer/radiosity/mesh/divide.hpp"

namespace radiosity {

Flat make_flat(const Face& face, int refine) {
  const auto& corners = face.corners;
  const Vec normal = normalize(eval_area_normal(corners));
  const auto bounds = renderer::make_bounds(corners);
  const std::vector<Plane> edges = make_edge_planes(corners, normal);
  double width = INFINITY;
  for (const Plane& edge : edges) {
    const auto height = [&](const Vec& corner) { return eval_height(edge, corner); };
    width = std::min(width, std::ranges::max(corners | std::views::transform(height)));
  }
  Face even = face;
  even.grid = {};
  return {
      &face, make_plane(normal, eval_mean(corners)), edges, bounds, length(bounds.hi - bounds.lo),
      width, find_patch_width(even, refine)};
}

Pair make_pair(const Flat& on, const Flat& other) {
  return {on, other, OFF_PLANE * std::max(on.size, other.size)};
}

bool are_coplanar(const Pair& pair) {
  return std::ranges::all_of(pair.other.face->corners, [&](const Vec& corner) {
    return std::abs(eval_height(pair.on.plane, corner)) <= pair.tolerance;
  });
}

bool overlap(const Pair& pair) {
  std::vector<Vec> part = pair.on.face->corners;
  for (const Plane& edge : pair.other.edges) {
    part = clip(part, edge, pair.tolerance);
    if (part.empty()) return false;
  }
  return length(eval_area_normal(part)) > 4 * pair.tolerance * pair.on.size;
}

bool share_border(const Pair& pair) {
  const auto& corners = pair.on.face->corners;
  for (std::size_t i = 0; i < corners.size(); ++i)
    if (clip_to(pair.other, {corners[i], corners[(i + 1) % corners.size()]}, -pair.tolerance,
                pair.tolerance))
      return true;
  return false;
}

std::optional<Crease> clip_to(const Flat& flat, const Crease& segment, double margin,
                              double tolerance) {
  const auto part = clip_segment(segment.a, segment.b, flat.edges, margin);
  if (!part || !((part->to - part->from) * length(segment.b - segment.a) > 2 * tolerance))
    return std::nullopt;
  return Crease{lerp(segment.a, segment.b, part->from), lerp(segment.a, segment.b, part->to)};
}

}  // namespace radiosity
