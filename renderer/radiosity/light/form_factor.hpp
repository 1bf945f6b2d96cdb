#pragma once
// Form factors from a patch to a vertex by ray casting (J. Wallace, K. Elmquist and E. Haines, "A
// Ray Tracing Algorithm for Progressive Radiosity", SIGGRAPH 1989; thesis, Eq 3.8 and 3.9).

#include <array>

#include "base/fields.hpp"
#include "renderer/radiosity/light/delta_areas.hpp"
#include "renderer/trace/intersect.hpp"

namespace radiosity {

inline constexpr int MOST_REFLECTIONS = 8;

/// How to divide a patch into delta areas. A delta area that is wider than `spread` or
/// `mirror_share` allows is halved along its longer side, or along both sides.
struct FactorParams {
  int samples = 1;       ///< number of delta areas along and across a patch, 1 to 1024
  double spread = 0.18;  ///< largest width of a delta area, as a fraction of its distance, > 0
  int halvings = 12;     ///< limit on the halvings of a delta area, 0 to 30; 0: equal sizes
  /// Limit on the number of mirrors in a path of light, 0 to MOST_REFLECTIONS.
  int reflections = 2;
  /// Replaces `spread` for delta areas seen in mirrors. It is the largest visual angle of a delta
  /// area, as a fraction of the visual angle of the narrowest mirror on the path, > 0. The result
  /// is clamped to the range from a quarter of `spread` to `spread`.
  double mirror_share = 0.5;
  /// Number of pieces along and across a mirror, 0 to 1000. With 0, mirrors are not divided in
  /// advance; each delta area is seen through its own piece of the mirror (mirrors.hpp).
  int mirror_pieces = 0;
  renderer::Traversal traversal = renderer::Traversal::nearest;
};

/// Makes the fields samples, spread, halvings, reflections, mirror_pieces and mirror_share.
base::Fields<FactorParams> factor_fields();
/// Throws BadInput with the name of the field, the value found and the values expected.
void check(const FactorParams& params);

/// The subdivision for direct light, without mirrors.
inline Cut direct_cut(const FactorParams& params) {
  return {params.samples, params.halvings, params.spread * params.spread};
}

/// Data for visibility tests that cast rays against Mesh::blockers. `access`, unless null, is
/// called for every read of scene data.
struct Eye {
  const Mesh& mesh;
  const FactorParams& params;
  renderer::Access* access = nullptr;
};

/// Fraction of the distance after which a visibility ray ends, so that it does not hit the target's
/// own object.
inline constexpr double NEARLY = 1 - 1e-9;

/// True if nothing blocks the segment from a point on one object to a point on another. Inlined, so
/// that the caller can reuse direction and length.
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

/// The radiosity of a patch as a bilinear function of the patch's parameters s and t.
struct Glow {
  static constexpr bool IS_EVEN = false;
  Glow() = default;
  explicit Glow(const Rgb& even) : at(even) {}
  /// Interpolates between the radiosities of the patch's corners, given in the order of
  /// Patch::corners.
  explicit Glow(const std::array<Rgb, 4>& corners);
  template <class Number>
  [[gnu::always_inline]] auto eval(const Number& s, const Number& t) const {
    return at + s * along + t * (across + s * twist);
  }
  /// True if all corners have the same radiosity.
  bool is_even() const { return along == Rgb{} && across == Rgb{} && twist == Rgb{}; }
  Rgb at, along, across, twist;
};

/// A constant radiosity, for templates that accept a Glow.
struct EvenGlow {
  static constexpr bool IS_EVEN = true;
  template <class Number>
  [[gnu::always_inline]] const Rgb& eval(const Number&, const Number&) const {
    return at;
  }
  Rgb at;
};

/// A patch that sends light, with the radiosity that it sends.
struct Sender {
  Sender(const Patch& patch, const Glow& glow)
      : patch(patch), quad(patch), glow(glow), is_even(glow.is_even()) {}
  const Patch& patch;
  Quad quad;
  Glow glow;
  bool is_even;
};

/// The subdivision of a sender for direct light. The delta areas of a lamp are made so small that
/// each one contributes at most Mesh::most_at_once of emitted light at a point. An upper bound on
/// the form factor guarantees this.
inline Cut direct_cut(const Eye& eye, const Sender& sender) {
  Cut cut = direct_cut(eye.params);
  const double emitted = sum(eye.mesh.materials[sender.patch.material].emission) / 3;
  if (emitted > 0)
    cut.enough = std::min(cut.enough, std::numbers::pi * eye.mesh.most_at_once / emitted);
  return cut;
}

/// The form factor without mirrors: the cosine-weighted fraction of the vertex's hemisphere that
/// the visible part of the patch covers, 0..1. It is the sum in thesis Eq 3.9 multiplied by A_2. In
/// this equation, B_1 is rho_1 B_2 times this fraction. Counts the work in `work`.
double eval_factor(const Eye& eye, const Vertex& vertex, const Patch& patch, renderer::Work& work);

/// True if light may reach vertices by way of mirrors.
inline bool has_mirrors(const Eye& eye) {
  return !eye.mesh.mirrors.empty() && eye.params.reflections > 0;
}

/// The light from a patch that arrives at a vertex, directly and via mirrors. Mirrors multiply
/// each colour by their reflectance. For a constant radiosity and no mirrors, the result is the
/// form factor multiplied by the radiosity. Counts the work in `work`.
Rgb eval_light(const Eye& eye, const Vertex& vertex, const Sender& sender, renderer::Work& work);

/// True if part of the patch is in front of the viewpoint's surface, and the viewpoint is in front
/// of the patch.
inline bool face_each_other(const Viewpoint& eye, const Patch& patch) {
  if (dot(patch.normal, eye.at - patch.centre) <= 0) return false;
  for (const Vec& corner : patch.at)
    if (dot(eye.normal, corner - eye.at) > 0) return true;
  return false;
}

}  // namespace radiosity
