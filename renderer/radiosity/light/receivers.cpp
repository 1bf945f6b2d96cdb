#include "renderer/radiosity/light/receivers.hpp"

#include "renderer/radiosity/light/mirrors.hpp"
#include "renderer/trace/shadow_rays.hpp"

namespace radiosity {

using renderer::count;
using renderer::holds_any;
using renderer::Lanes;
using renderer::LANES;
using renderer::Mask;
using renderer::Op;
using renderer::Vecs;
using renderer::Work;

namespace {

// The receivers in lanes; what is missing is somewhere, and left out.
struct Points {
  explicit Points(const Receivers& receivers) {
    const auto& [a, b, c, d] = receivers;
    const Vertex &second = b ? *b : *a, &third = c ? *c : *a, &fourth = d ? *d : *a;
    const auto gather = [&](Vec Vertex::*point) __attribute__((always_inline)) {
      const Vec &e = a->*point, &f = second.*point, &g = third.*point, &h = fourth.*point;
      return Vecs{{e.x, f.x, g.x, h.x}, {e.y, f.y, g.y, h.y}, {e.z, f.z, g.z, h.z}};
    };
    at = gather(&Vertex::lit);
    normal = gather(&Vertex::normal);
    object = Mask{a->object, second.object, third.object, fourth.object};
    present = Mask{-1, -(b != nullptr), -(c != nullptr), -(d != nullptr)};
  }
  Vecs at, normal;
  Mask object, present;
};

// As face_each_other() of each.
[[gnu::always_inline]] inline Mask find_facing(const Points& points, const Patch& patch) {
  Mask before{};
  for (const Vec& corner : patch.at) before |= dot(corner - points.at, points.normal) > 0.0;
  return points.present & before & (dot(points.at - patch.centre, patch.normal) > 0.0);
}

// Which of the ways to a point of the patch nothing blocks: as sees() of each.
[[gnu::always_inline]] inline Mask find_seeing(const Eye& eye, const Points& points,
                                               const Patch& patch, const Mask& looking,
                                               const Vecs& way, const Lanes& square, Work& work) {
  const Lanes distance = renderer::sqrt(square);
  renderer::ShadowRays rays;
  rays.origin = points.at;
  rays.direction = (1.0 / distance) * way;
  rays.reach = distance * NEARLY;
  rays.from = points.object;
  rays.cast = looking & (points.object != static_cast<std::int64_t>(patch.object));
  find_blocked(eye.mesh.blockers, rays, work);
  return looking & ~rays.blocked;
}

// What arrives directly at those that see the patch as one delta area, to which Eq 3.8 does not
// apply; of the others 0, and who they are.
struct Far {
  Lights lights{};
  Mask near{};
};

TLAB_WIDE_REGISTERS
void eval_far_lights(const Eye& eye, const Receivers& receivers, const Sender& sender, Far& result,
                     Work& work) {
  const auto& [patch, quad, glow, is_even] = sender;
  const Points points(receivers);
  const Mask facing = find_facing(points, patch);
  result = Far{};
  if (!holds_any(facing)) {
    work[Op::factor_begun] += count(points.present);
    return;
  }

  constexpr Delta WHOLE{0.5, 0.5, 1, 1};
  const DeltaSize size(quad, WHOLE);
  const Vecs way = find_aim(quad, WHOLE) - points.at;
  const Lanes square = dot(way, way);
  const double enough = eye.params.spread * eye.params.spread;
  result.near = facing & (std::max(size.square_a, size.square_b) > square);
  if (eye.params.halvings > 0)
    result.near |= facing & (std::max(quad.along, quad.across) > enough * square);
  work[Op::factor_begun] += count(points.present & ~result.near);
  work[Op::delta_area] += count(facing & ~result.near);

  const Lanes here = dot(way, points.normal), there = -dot(way, quad.normal);
  Mask seeing = facing & ~result.near & (here > 0.0) & (there > 0.0);
  if (!holds_any(seeing)) return;
  seeing = find_seeing(eye, points, patch, seeing, way, square, work);
  if (!holds_any(seeing)) return;
  const Rise<Lanes> rise{dot(points.normal, quad.a), dot(points.normal, quad.b),
                         dot(points.normal, quad.c)};
  if (is_even) {
    const Lanes terms = eval_far(quad, WHOLE, size, rise, way, square, here, there, Even{});
    for (std::size_t k = 0; k < LANES; ++k)
      if (seeing[k]) result.lights[k] = terms[k] * glow.at;
  } else {
    work[Op::glow_found] += count(seeing);
    const renderer::Rgbs terms = eval_far(quad, WHOLE, size, rise, way, square, here, there, glow);
    for (std::size_t k = 0; k < LANES; ++k)
      if (seeing[k]) result.lights[k] = {terms.r[k], terms.g[k], terms.b[k]};
  }
}

}  // namespace

Lights eval_lights(const Eye& eye, const Receivers& receivers, const Sender& sender, Work& work) {
  const bool alone =
      eye.params.samples > 1 || eye.access || eye.params.traversal != renderer::Traversal::nearest;
  Far far;
  if (!alone) eval_far_lights(eye, receivers, sender, far, work);
  for (std::size_t k = 0; k < LANES && receivers[k]; ++k) {
    const Vertex& vertex = *receivers[k];
    if (alone || far.near[k]) far.lights[k] = eval_direct_light(eye, vertex, sender, work);
    if (has_mirrors(eye)) far.lights[k] += eval_mirrored_light(eye, vertex, sender, work);
  }
  return far.lights;
}

}  // namespace radiosity
