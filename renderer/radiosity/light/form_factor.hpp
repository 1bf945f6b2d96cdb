#pragma once
// Form factors of a patch to a vertex, by casting rays: J. Wallace, K. Elmquist and E. Haines, "A
// Ray Tracing Algorithm for Progressive Radiosity", SIGGRAPH 1989; thesis, Eq 3.8 and 3.9.

#include <algorithm>
#include <numbers>

#include "base/fields.hpp"
#include "renderer/radiosity/mesh/mesh.hpp"
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
  /// Pieces of a mirror along and across, 0 to 10000; 0: a piece for each delta area, through which
  /// that is seen (mirrors.hpp).
  int mirror_pieces = 0;
  renderer::Traversal traversal = renderer::Traversal::nearest;
};

/// The fields samples, spread, halvings, reflections, mirror_pieces and mirror_share.
base::Fields<FactorParams> factor_fields();
/// BadInput naming the field, what was found and what was expected.
void check(const FactorParams& params);

/// What visibility is found with: rays are cast against the blockers of `mesh`. `access`, unless
/// null, is told of all that is read.
struct Eye {
  const Mesh& mesh;
  const FactorParams& params;
  renderer::Access* access = nullptr;
};

/// Whether nothing blocks the way from a point on one object to a point on another.
bool sees(const Eye& eye, const Vec& from, std::uint32_t object, const Vec& to, std::uint32_t other,
          renderer::Work& work);

/// The sum of Eq 3.9 times A_2, without mirrors: the share of the vertex's hemisphere, weighted by
/// its cosine, in which the patch is seen, 0..1; B_1 = rho_1 B_2 times it. Adds to `work`.
double eval_factor(const Eye& eye, const Vertex& vertex, const Patch& patch, renderer::Work& work);

/// eval_factor() and what arrives by way of mirrors, each colour times the mirrors' reflectance.
Rgb eval_factors(const Eye& eye, const Vertex& vertex, const Patch& patch, renderer::Work& work);

// A patch cut into delta areas, as a point sees it: the sum of Eq 3.8.

/// A patch as a function of its parameters: p + s a + t b + s t c.
struct Quad {
  explicit Quad(const Patch& patch) : normal(patch.normal) {
    p = patch.at[0];
    a = patch.at[1] - p;
    b = patch.at[3] - p;
    c = patch.at[2] - patch.at[1] - b;
    along = std::max(dot(a, a), dot(a + c, a + c));
    across = std::max(dot(b, b), dot(b + c, b + c));
    by_s = dot(normal, cross(a, c));
    by_t = dot(normal, cross(c, b));
  }
  Vec eval(double s, double t) const { return p + s * a + t * (b + s * c); }
  /// Area for each unit of s and t.
  double eval_density(double s, double t) const { return dot(normal, cross(a + t * c, b + s * c)); }
  Vec p, a, b, c, normal;
  double along, across;  // squares of the longer of opposite sides
  double by_s, by_t;     // how eval_density() grows
};

/// A point that looks, and the normal of the surface that it lies on.
struct Viewpoint {
  Vec at, normal;
};

/// A term of Eq 3.8, with A_2/N = `area`; `square` of the distance, `here` and `there` the cosines
/// times the distance.
inline double eval_delta(double area, double square, double here, double there) {
  return here * there / square * area / (std::numbers::pi * square + area);
}

/// A side of a delta area, at its middle, and how much longer the other side is at its end than at
/// its beginning, over its length.
struct DeltaSide {
  Vec along;
  double growth = 0;
};

/// How much a delta area whose centre is `way` off differs from a point with its area: its factor
/// is 1 + eval_extent() times that of the point, up to the fourth power of side over distance.
/// The kernel's second derivatives along the sides, over 24, make the difference, and, where a side
/// grows, that more of the area lies towards its end. `normal` is the viewpoint's.
inline double eval_extent(const Vec& normal, const Vec& way, const DeltaSide& a,
                          const DeltaSide& b) {
  // Divisions are what costs here.
  const double per_square = 1 / dot(way, way), per_here = 1 / dot(normal, way);
  const auto eval = [&](const DeltaSide& side) {
    const double turn = per_square * dot(way, side.along),
                 rise = per_here * dot(normal, side.along);
    return turn * (turn - 1.0 / 3 * rise) - 1.0 / 6 * per_square * dot(side.along, side.along) +
           1.0 / 12 * side.growth * (rise - 4 * turn);
  };
  return eval(a) + eval(b);
}

/// The sum over a patch: of Eq 3.8 where a delta area is wider than it is far, else of what is
/// exact to the second order in side over distance (Eq 3.8 is for a disc that faces the viewpoint,
/// and loses 0.3 % of the light of a room). `sight.sees(point)` says whether the viewpoint sees a
/// point of the patch, `sight.misses(point, radius)` whether it surely sees none within the radius.
template <class Sight>
struct DeltaAreas {
  const FactorParams& params;
  double enough;  ///< widest delta area that is not halved: the square of its share of the distance
  const Viewpoint& eye;
  const Quad& quad;
  const Sight& sight;
  renderer::Work& work;

  double sum() {
    const int n = params.samples;
    double total = 0;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        total += add({(i + 0.5) / n, (j + 0.5) / n, 1.0 / n, 1.0 / n}, params.halvings);
    return total;
  }

 private:
  // A delta area around (s, t); its sides are shares of the patch's.
  struct Delta {
    double s, t, along, across;
  };

  double add(const Delta& delta, int halvings) {
    work[renderer::Op::delta_area] += 1;
    // Not quite the centre: in rooms full of symmetry lines between centres pass exactly through
    // edges, of two mirrors above all, and rounding would say by which side.
    constexpr double ASIDE = 0.7e-6, ABOVE = 1.1e-6;
    const Vec point = quad.eval(delta.s + ASIDE * delta.along, delta.t + ABOVE * delta.across);
    const Vec way = point - eye.at;
    const double square = dot(way, way);
    if (halvings > 0) {
      const double along = delta.along * delta.along * quad.along;
      const double across = delta.across * delta.across * quad.across;
      const double wide = std::max(along, across);
      if (wide > enough * square)
        return sight.misses(point, std::sqrt(along + across) / 2)
                   ? 0
                   : add_parts(delta, 2 * along > wide, 2 * across > wide, halvings - 1);
    }
    const double here = dot(eye.normal, way), there = -dot(quad.normal, way);
    if (here <= 0 || there <= 0 || !sight.sees(point)) return 0;
    const double density = quad.eval_density(delta.s, delta.t);
    const double area = delta.along * delta.across * density;
    const double per_density = 1 / density;
    const DeltaSide a{delta.along * (quad.a + delta.t * quad.c),
                      per_density * delta.along * quad.by_s};
    const DeltaSide b{delta.across * (quad.b + delta.s * quad.c),
                      per_density * delta.across * quad.by_t};
    if (std::max(dot(a.along, a.along), dot(b.along, b.along)) > square)
      return eval_delta(area, square, here, there);
    const double extent = eval_extent(eye.normal, way, a, b);
    const double factor = here * there * area / (std::numbers::pi * square * square);
    return extent > 0 ? factor * (1 + extent) : factor / (1 - extent);
  }

  // The sum over the parts of a delta area that is halved along, across, or both.
  double add_parts(const Delta& delta, bool along, bool across, int halvings) {
    const double step = along ? delta.along / 4 : 0, rise = across ? delta.across / 4 : 0;
    const double width = along ? delta.along / 2 : delta.along;
    const double height = across ? delta.across / 2 : delta.across;
    double total = 0;
    for (int j = across ? -1 : 0; j <= (across ? 1 : 0); j += 2)
      for (int i = along ? -1 : 0; i <= (along ? 1 : 0); i += 2)
        total += add({delta.s + i * step, delta.t + j * rise, width, height}, halvings);
    return total;
  }
};

/// Whether a part of the patch is in front of the viewpoint, and the viewpoint in front of it.
inline bool face_each_other(const Viewpoint& eye, const Patch& patch) {
  if (dot(patch.normal, eye.at - patch.centre) <= 0) return false;
  for (const Vec& corner : patch.at)
    if (dot(eye.normal, corner - eye.at) > 0) return true;
  return false;
}

}  // namespace radiosity
