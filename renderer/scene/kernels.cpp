#include "renderer/scene/kernels.hpp"

namespace renderer {

Vec eval_normal(const Patch& patch, const Corner* corners, const Vec* normals, const Vec& point) {
  const Polygon& flat = patch.flat;
  const double pu = point[flat.u], pv = point[flat.v];
  const auto spoke = [&](std::uint32_t i) {
    const Corner& c = corners[flat.first + i];
    return Corner{c.u - pu, c.v - pv};
  };
  const auto size = [](const Corner& c) { return std::sqrt(c.u * c.u + c.v * c.v); };

  Vec sum;
  for (std::uint32_t i = flat.count - 1, j = 0; j < flat.count; i = j++) {
    const Corner a = spoke(i), b = spoke(j);
    const Vec &normal_a = normals[patch.normals + i], &normal_b = normals[patch.normals + j];
    const double a_size = size(a), b_size = size(b);
    if (a_size == 0) return normal_a;
    if (b_size == 0) return normal_b;
    const double below = a_size * b_size + a.u * b.u + a.v * b.v;
    // On the edge itself: linear between its ends.
    if (!(below > 0)) return normalize(b_size * normal_a + a_size * normal_b);
    const double half_tan = (a.u * b.v - a.v * b.u) / below;  // of the angle the edge is seen under
    sum += (half_tan / a_size) * normal_a + (half_tan / b_size) * normal_b;
  }
  // From the back of the projection all angles are negative.
  if (dot(sum, flat.normal) < 0) sum = -sum;
  const double norm = length(sum);
  return norm > 0 && norm < NO_HIT ? (1 / norm) * sum : flat.normal;
}

}  // namespace renderer
