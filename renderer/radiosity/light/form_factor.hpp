#pragma once
// Form factors of a patch to a vertex, by casting rays: J. Wallace, K. Elmquist and E. Haines, "A
// Ray Tracing Algorithm for Progressive Radiosity", SIGGRAPH 1989; thesis, Eq 3.8 and 3.9.

#include <array>

#include "base/fields.hpp"
#include "renderer/radiosity/light/delta_areas.hpp"
#include "renderer/trace/intersect.hpp"

namespace radiosity {

inline constexpr int MOST_REFLECTIONS = 8;

/// A patch is cut into delta areas. One that is too wide, `spread` and `mirror_share` say, is
/// halved, along its longer side or both.
struct FactorParams {
  int samples = 1;       ///< delta areas along and across a patch, 1 to 1024
  double spread = 0.18;  ///< widest delta area that is not halved, a share of its distance, > 0
  int halvings = 12;     ///< most halvings of a delta area, 0 to 30; 0: all have equal size
  int reflections = 2;   ///< most mirrors that light may meet on its way, 0 to MOST_REFLECTIONS
  /// Widest delta area that is not halved where it is seen in mirrors, a share of the narrowest of
  /// them as both are seen, > 0; not halved more than if spread were a quarter.
  double mirror_share = 0.5;
  /// Pieces of a mirror along and across, 0 to 1000; 0: a piece for each delta area, through which
  /// that is seen (mirrors.hpp).
  int mirror_pieces = 0;
  renderer::Traversal traversal = renderer::Traversal::nearest;
};

/// The fields samples, spread, halvings, reflections, mirror_pieces and mirror_share.
base::Fields<FactorParams> factor_fields();
/// BadInput naming the field, what was found and what was expected.
void check(const FactorParams& params);

/// How delta areas are cut where light comes directly.
inline Cut direct_cut(const FactorParams& params) {
  return {params.samples, params.halvings, params.spread * params.spread};
}

/// Visibility queries: rays are cast against the blockers of `mesh`. `access`, unless null,
/// receives every read.
struct Eye {
  const Mesh& mesh;
  const FactorParams& params;
  renderer::Access* access = nullptr;
};

/// The share of the distance at which a ray ends, so that it does not meet the object it goes to.
inline constexpr double NEARLY = 1 - 1e-9;

/// Returns true if nothing blocks the segment between points on two objects. Inlined, so that the
/// caller shares the direction and its length.
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

/// The radiosity of a patch's points, bilinear in its parameters.
struct Glow {
  static constexpr bool IS_EVEN = false;
  Glow() = default;
  explicit Glow(const Rgb& even) : at(even) {}
  /// From those of the corners, in their order.
  explicit Glow(const std::array<Rgb, 4>& corners);
  template <class Number>
  [[gnu::always_inline]] auto eval(const Number& s, const Number& t) const {
    return at + s * along + t * (across + s * twist);
  }
  /// Returns true if it is constant over the patch.
  bool is_even() const { return along == Rgb{} && across == Rgb{} && twist == Rgb{}; }
  Rgb at, along, across, twist;
};

/// An even glow, for templates that take a Glow.
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

/// How delta areas of a sender are cut where light comes directly: none of a lamp would give more
/// of what it emits than Mesh::most_at_once, by its form factor at most.
inline Cut direct_cut(const Eye& eye, const Sender& sender) {
  Cut cut = direct_cut(eye.params);
  const double emitted = sum(eye.mesh.materials[sender.patch.material].emission) / 3;
  if (emitted > 0)
    cut.enough = std::min(cut.enough, std::numbers::pi * eye.mesh.most_at_once / emitted);
  return cut;
}

/// The sum of Eq 3.9 times A_2, without mirrors: the cosine-weighted share of the vertex's
/// hemisphere that the visible patch covers, 0..1. B_1 is rho_1 B_2 times it. Adds to `work`.
double eval_factor(const Eye& eye, const Vertex& vertex, const Patch& patch, renderer::Work& work);

/// Returns true if light may arrive by mirrors.
inline bool has_mirrors(const Eye& eye) {
  return !eye.mesh.mirrors.empty() && eye.params.reflections > 0;
}

/// The light from a patch that arrives at a vertex, directly and by mirrors, with each colour
/// scaled by their reflectance. For an even glow it is the form factors times the glow. Adds to
/// `work`.
Rgb eval_light(const Eye& eye, const Vertex& vertex, const Sender& sender, renderer::Work& work);

/// Returns true if part of the patch is in front of the viewpoint and the viewpoint in front of the
/// patch.
inline bool face_each_other(const Viewpoint& eye, const Patch& patch) {
  if (dot(patch.normal, eye.at - patch.centre) <= 0) return false;
  for (const Vec& corner : patch.at)
    if (dot(eye.normal, corner - eye.at) > 0) return true;
  return false;
}

}  // namespace radiosity
