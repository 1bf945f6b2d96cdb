#include "renderer/radiosity/light/form_factor.hpp"

#include "renderer/radiosity/light/delta_areas.hpp"
#include "renderer/radiosity/light/mirrors.hpp"
#include "renderer/scene/require.hpp"

namespace radiosity {

using renderer::Op;
using renderer::Work;

namespace {

// The share of the distance to a point within which a ray does not meet the object of the point.
constexpr double NEARLY = 1 - 1e-9;

// How a vertex sees a patch directly, for DeltaAreas.
struct DirectSight {
  const Eye& eye;
  const Vertex& vertex;
  const Patch& patch;
  Work& work;
  bool sees(const Vec& point) const {
    return radiosity::sees(eye, vertex.lit, vertex.object, point, patch.object, work);
  }
  static bool misses(const Vec&, double) { return false; }
};

}  // namespace

void check(const FactorParams& params) {
  using renderer::require;
  require(params.samples >= 1 && params.samples <= 1024, "samples", params.samples, "1 to 1024");
  require(params.spread > 0, "spread", params.spread, "more than 0");
  require(params.halvings >= 0 && params.halvings <= 30, "halvings", params.halvings, "0 to 30");
  require(params.reflections >= 0 && params.reflections <= MOST_REFLECTIONS, "reflections",
          params.reflections, "0 to 8");
  require(params.mirror_share > 0, "mirror_share", params.mirror_share, "more than 0");
  require(params.mirror_pieces >= 0 && params.mirror_pieces <= 10000, "mirror_pieces",
          params.mirror_pieces, "0 to 10000");
}

bool sees(const Eye& eye, const Vec& from, std::uint32_t object, const Vec& to, std::uint32_t other,
          Work& work) {
  if (object == other) return true;
  const Vec way = to - from;
  const double distance = length(way);
  renderer::Ray ray;
  ray.origin = from;
  ray.direction = (1 / distance) * way;
  ray.reach = distance * NEARLY;
  ray.from = object;
  ray.kind = renderer::RayKind::shadow;
  const auto& blockers = eye.mesh.blockers;
  return !(eye.access ? intersect(blockers, ray, eye.params.traversal, work, *eye.access)
                      : intersect(blockers, ray, eye.params.traversal, work));
}

double eval_factor(const Eye& eye, const Vertex& vertex, const Patch& patch, Work& work) {
  work[Op::factor_begun] += 1;
  const Viewpoint view{vertex.lit, vertex.normal};
  if (!face_each_other(view, patch)) return 0;
  const DirectSight sight{eye, vertex, patch, work};
  return DeltaAreas(eye.params, eye.params.spread, view, Quad(patch), sight, work).sum();
}

Rgb eval_factors(const Eye& eye, const Vertex& vertex, const Patch& patch, Work& work) {
  const double direct = eval_factor(eye, vertex, patch, work);
  const Rgb all{direct, direct, direct};
  if (eye.mesh.mirrors.empty() || eye.params.reflections == 0) return all;
  return all + eval_mirrored_factor(eye, vertex, patch, work);
}

}  // namespace radiosity
