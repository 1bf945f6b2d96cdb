#pragma once
// Form factors from a patch to a vertex by ray casting (J. Wallace, K. Elmquist and E. Haines, "A
// Ray Tracing Algorithm for Progressive Radiosity", SIGGRAPH 1989; thesis, Eq 3.8 and 3.9).

#include <array>

#include "base/fields.hpp"
#include "renderer/radiosity/light/delta_areas.hpp"
#include "renderer/trace/intersect.hpp"

namespace radiosity {

inline constexpr int MOST_REFLECTIONS = 8;

/// Subdivision of a patch into delta areas. A delta area that is wider than `spread` or
/// `mirror_share` allows is halved along its longer side or both sides.
struct FactorParams {
  int samples = 1;       ///< delta areas along and across a patch, 1 to 1024
  double spread = 0.18;  ///< largest width of a delta area, as a share of its distance, > 0
  int halvings = 12;     ///< limit on the halvings of a delta area, 0 to 30; 0: all have equal size
  int reflections = 2;   ///< limit on the mirrors on a path of light, 0 to MOST_REFLECTIONS
  /// Replaces `spread` for delta areas seen over mirrors: largest angle of a delta area, as a share
  /// of the angle of the narrowest mirror as seen from the vertex, > 0. The result is clamped to a
  /// quarter of `spread` up to `spread`.
  double mirror_share = 0.5;
  /// Pieces along and across a mirror, 0 to 1000. With 0, mirrors are not divided; each delta area
  /// is seen through a piece of its own (mirrors.hpp).
  int mirror_pieces = 0;
  renderer::Traversal traversal = renderer::Traversal::nearest;
};

/// Makes the fields samples, spread, halvings, reflections, mirror_pieces and mirror_share.
base::Fields<FactorParams> factor_fields();
/// Throws BadInput with the field, the value found and the values expected.
void check(const FactorParams& params);

/// The subdivision into delta areas for direct light.
inline Cut direct_cut(const FactorParams& params) {
  return {params.samples, params.halvings, params.spread * params.spread};
}

/// A visibility tester that casts rays against the blockers of `mesh`. `access`, unless null,
/// receives every read.
struct Eye {
  const Mesh& mesh;
  const FactorParams& params;
  renderer::Access* access = nullptr;
};

/// Share of the distance at which a ray ends, so that it does not meet the object at its target.
inline constexpr double NEARLY = 1 - 1e-9;

/// True if nothing blocks the segment between points on two objects. Inlined, so that the caller
/// shares the direction and its length.
[[gnu::always_inline]] inline bool sees(const Eye& eye, const Vec& from, std::uint32_t object,
                                        const Vec& to, std::uint32_t other, renderer::Work& work) {
  if (object == other) return true;
  const Vec way = to - from;
  const double distance = length(way);
  renderer::Ray ray;
  ray.origin = from;
  ray.direction = (1 / distance) * way;
  ray.reach = distance * NEARLY;
  ray.from = object;
  ray.kind = renderer::RayKind::shadow;
  return !intersect(eye.mesh.blockers, ray, eye.params.traversal, work, eye.access);
}

/// Radiosity of a patch, bilinear in the patch's parameters.
struct Glow {
  static constexpr bool IS_EVEN = false;
  Glow() = default;
  explicit Glow(const Rgb& even) : at(even) {}
  /// Makes it from the radiosities of the patch's corners, in their order.
  explicit Glow(const std::array<Rgb, 4>& corners);
  template <class Number>
  [[gnu::always_inline]] auto eval(const Number& s, const Number& t) const {
    return at + s * along + t * (across + s * twist);
  }
  /// True if the radiosity is constant over the patch.
  bool is_even() const { return along == Rgb{} && across == Rgb{} && twist == Rgb{}; }
  Rgb at, along, across, twist;
};

/// A constant radiosity, for templates that take a Glow.
struct EvenGlow {
  static constexpr bool IS_EVEN = true;
  template <class Number>
  [[gnu::always_inline]] const Rgb& eval(const Number&, const Number&) const {
    return at;
  }
  Rgb at;
};

/// A patch that sends light.
struct Sender {
  Sender(const Patch& patch, const Glow& glow)
      : patch(patch), quad(patch), glow(glow), is_even(glow.is_even()) {}
  const Patch& patch;
  Quad quad;
  Glow glow;
  bool is_even;
};

/// The subdivision of a sender for direct light. Delta areas of lamps are so small that none
/// contributes more than Mesh::most_at_once to the emitted light at a point, by an upper bound on
/// form factors.
inline Cut direct_cut(const Eye& eye, const Sender& sender) {
  Cut cut = direct_cut(eye.params);
  const double emitted = sum(eye.mesh.materials[sender.patch.material].emission) / 3;
  if (emitted > 0)
    cut.enough = std::min(cut.enough, std::numbers::pi * eye.mesh.most_at_once / emitted);
  return cut;
}

/// The sum of Eq 3.9 times A_2, without mirrors: the cosine-weighted share of the vertex's
/// hemisphere that the visible part of the patch covers, 0..1. In Eq 3.9, B_1 is rho_1 B_2 times
/// this share. Adds to `work`.
double eval_factor(const Eye& eye, const Vertex& vertex, const Patch& patch, renderer::Work& work);

/// True if light may arrive over mirrors.
inline bool has_mirrors(const Eye& eye) {
  return !eye.mesh.mirrors.empty() && eye.params.reflections > 0;
}

/// The light from a patch that arrives at a vertex, directly and over mirrors. Mirrors multiply
/// each colour by their reflectance. For a constant radiosity it is the form factor times the
/// radiosity. Adds to `work`.
Rgb eval_light(const Eye& eye, const Vertex& vertex, const Sender& sender, renderer::Work& work);

/// True if part of the patch is in front of the viewpoint, and the viewpoint is in front of the
/// patch.
inline bool face_each_other(const Viewpoint& eye, const Patch& patch) {
  if (dot(patch.normal, eye.at - patch.centre) <= 0) return false;
  for (const Vec& corner : patch.at)
    if (dot(eye.normal, corner - eye.at) > 0) return true;
  return false;
}

}  // namespace radiosity
