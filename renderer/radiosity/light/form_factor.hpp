#pragma once
// Form factors of a patch to a vertex, by casting rays: J. Wallace, K. Elmquist and E. Haines, "A
// Ray Tracing Algorithm for Progressive Radiosity", SIGGRAPH 1989; thesis, Eq 3.8 and 3.9.

#include <algorithm>
#include <array>
#include <concepts>
#include <numbers>
#include <utility>

#include "base/fields.hpp"
#include "renderer/radiosity/mesh/mesh.hpp"
#include "renderer/scene/lanes.hpp"
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

/// The share of the distance between two points within which a ray does not meet the other's
/// object.
inline constexpr double NEARLY = 1 - 1e-9;

/// Whether nothing blocks the way from a point on one object to a point on another. Inlined: the
/// caller computes the way and its length too, and shares them.
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

// A patch cut into delta areas, as a point sees it: the sum of Eq 3.8.

/// A patch as a function of its parameters: p + s a + t b + s t c.
struct Quad {
  explicit Quad(const Patch& patch) : normal(patch.normal) {
    p = patch.at[0];
    a = patch.at[1] - p;
    b = patch.at[3] - p;
    c = patch.at[2] - patch.at[1] - b;
    aa = dot(a, a), ac = dot(a, c), bb = dot(b, b), bc = dot(b, c), cc = dot(c, c);
    along = std::max(aa, dot(a + c, a + c));
    across = std::max(bb, dot(b + c, b + c));
    density = dot(normal, cross(a, b));
    by_s = dot(normal, cross(a, c));
    by_t = dot(normal, cross(c, b));
  }
  [[gnu::always_inline]] Vec eval(double s, double t) const { return p + s * a + t * (b + s * c); }
  /// Area for each unit of s and t.
  double eval_density(double s, double t) const { return density + s * by_s + t * by_t; }
  Vec p, a, b, c, normal;
  double along, across;        // squares of the longer of opposite sides
  double density, by_s, by_t;  // eval_density() at (0, 0), and how it grows
  double aa, ac, bb, bc, cc;   // products of a, b and c
};

/// The radiosity of a patch's points, bilinear in its parameters.
struct Glow {
  Glow() = default;
  explicit Glow(const Rgb& even) : at(even) {}
  /// From those of the corners, in their order.
  explicit Glow(const std::array<Rgb, 4>& corners);
  template <class Number>
  [[gnu::always_inline]] auto eval(const Number& s, const Number& t) const {
    return at + s * along + t * (across + s * twist);
  }
  /// Whether it is the same everywhere.
  bool is_even() const { return along == Rgb{} && across == Rgb{} && twist == Rgb{}; }
  Rgb at, along, across, twist;
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

/// The sum of Eq 3.9 times A_2, without mirrors: the share of the vertex's hemisphere, weighted by
/// its cosine, in which the patch is seen, 0..1; B_1 = rho_1 B_2 times it. Adds to `work`.
double eval_factor(const Eye& eye, const Vertex& vertex, const Patch& patch, renderer::Work& work);

/// Whether there are mirrors by way of which light arrives.
inline bool has_mirrors(const Eye& eye) {
  return !eye.mesh.mirrors.empty() && eye.params.reflections > 0;
}

/// The light that arrives at a vertex directly: its form factor times the glow. Adds to `work`.
Rgb eval_direct_light(const Eye& eye, const Vertex& vertex, const Sender& sender,
                      renderer::Work& work);

/// The light that arrives at a vertex, also by way of mirrors, each colour times their reflectance.
/// Where the patch glows evenly, that is its form factors, direct and over mirrors, times the glow.
/// Adds to `work`.
Rgb eval_light(const Eye& eye, const Vertex& vertex, const Sender& sender, renderer::Work& work);

/// A point that looks, and the normal of the surface that it lies on.
struct Viewpoint {
  Vec at, normal;
};

/// A term of Eq 3.8, with A_2/N = `area`; `square` of the distance, `here` and `there` the cosines
/// times the distance.
inline double eval_delta(double area, double square, double here, double there) {
  return here * there / square * area / (std::numbers::pi * square + area);
}

/// A side of a delta area, at its middle, as a point sees it from afar, or as several points do.
template <class Number>
struct DeltaSide {
  Number turn;    ///< its part along the way to the delta area's centre, over the way's length
  Number rise;    ///< its part along the viewpoint's normal, over the way's part along that
  Number square;  ///< of its length over the way's
  double growth;  ///< how much longer the other side is at its end than at its beginning, over that

  /// Its share of eval_extent().
  [[gnu::always_inline]] Number eval_extent() const {
    return turn * (turn - 1.0 / 3 * rise) - 1.0 / 6 * square +
           1.0 / 12 * growth * (rise - 4.0 * turn);
  }
  /// How far off the delta area's centre the middle of its factor lies along the side, as a share
  /// of its length, to the first order.
  [[gnu::always_inline]] Number eval_drift() const {
    using renderer::clamp, std::clamp;
    return clamp(1.0 / 12 * (growth + rise - 4.0 * turn), -0.5, 0.5);
  }
};

/// How much a delta area differs from a point with its area: its factor is 1 + eval_extent() times
/// that of the point, up to the fourth power of side over distance. The kernel's second derivatives
/// along the sides, over 24, make the difference, and, where a side grows, that more of the area
/// lies towards its end.
template <class Number>
[[gnu::always_inline]] inline Number eval_extent(const DeltaSide<Number>& a,
                                                 const DeltaSide<Number>& b) {
  return a.eval_extent() + b.eval_extent();
}

/// A patch that glows evenly, with 1.
struct Even {
  template <class Number>
  [[gnu::always_inline]] static double eval(const Number&, const Number&) {
    return 1;
  }
};

/// A part of a patch around (s, t); its sides are shares of the patch's.
struct Delta {
  double s, t, along, across;
};

/// Where a delta area is looked at. Not quite the centre: in rooms full of symmetry lines between
/// centres pass exactly through edges, of two mirrors above all, and rounding would say by which
/// side.
[[gnu::always_inline]] inline Vec find_aim(const Quad& quad, const Delta& delta) {
  constexpr double ASIDE = 0.7e-6, ABOVE = 1.1e-6;
  return quad.eval(delta.s + ASIDE * delta.along, delta.t + ABOVE * delta.across);
}

/// What a delta area measures at its middle.
struct DeltaSize {
  DeltaSize(const Quad& quad, const Delta& delta)
      : density(quad.eval_density(delta.s, delta.t)),
        area(delta.along * delta.across * density),
        square_a(delta.along * delta.along *
                 (quad.aa + delta.t * (2 * quad.ac + delta.t * quad.cc))),
        square_b(delta.across * delta.across *
                 (quad.bb + delta.s * (2 * quad.bc + delta.s * quad.cc))) {}
  double density, area;
  double square_a, square_b;  ///< of the lengths of its sides
};

/// How the patch's sides rise along a viewpoint's normal: its products with Quad's a, b and c.
template <class Number>
struct Rise {
  Number a, b, c;
};

/// The term of a delta area whose sides are shorter than its distance, exact to the second order in
/// side over distance, times `source.eval(s, t)`. `way` leads there, `square` is its length's,
/// `here` and `there` are as in eval_delta(). Vector may be of several ways, as Number.
template <class Vector, class Number, class Source>
[[gnu::always_inline]] inline auto eval_far(const Quad& quad, const Delta& delta,
                                            const DeltaSize& size, const Rise<Number>& rise,
                                            const Vector& way, const Number& square,
                                            const Number& here, const Number& there,
                                            const Source& source) {
  const auto [s, t, along, across] = delta;
  // Divisions are what costs here.
  const Number per_square = 1.0 / square, per_here = 1.0 / here;
  const double per_density = 1 / size.density;
  const Number way_c = dot(way, quad.c);
  const DeltaSide<Number> a{per_square * along * (dot(way, quad.a) + t * way_c),
                            per_here * along * (rise.a + t * rise.c), per_square * size.square_a,
                            per_density * along * quad.by_s};
  const DeltaSide<Number> b{per_square * across * (dot(way, quad.b) + s * way_c),
                            per_here * across * (rise.b + s * rise.c), per_square * size.square_b,
                            per_density * across * quad.by_t};
  const Number extent = eval_extent(a, b);
  const Number factor = std::numbers::inv_pi * here * there * size.area * (per_square * per_square);
  const Number term = extent > 0.0 ? factor * (1.0 + extent) : factor / (1.0 - extent);
  const Number at_s = s + a.eval_drift() * along, at_t = t + b.eval_drift() * across;
  return term * source.eval(at_s, at_t);
}

/// The sum over a patch: of Eq 3.8 where a delta area is wider than it is far, else of what is
/// exact to the second order in side over distance (Eq 3.8 is for a disc that faces the viewpoint,
/// and loses 0.3 % of the light of a room); each times `source.eval(s, t)`. `sight.sees(point)`
/// says whether the viewpoint sees a point of the patch, `sight.misses(point, radius)` whether it
/// surely sees none within the radius.
template <class Sight, class Source>
class DeltaAreas {
 public:
  using Sum = decltype(1.0 * std::declval<Source>().eval(0, 0));

  /// `enough`: the widest delta area that is not halved, the square of its share of the distance.
  DeltaAreas(const FactorParams& params, double enough, const Viewpoint& eye, const Quad& quad,
             const Sight& sight, const Source& source, renderer::Work& work)
      : params_(params),
        enough_(enough),
        eye_(eye),
        quad_(quad),
        sight_(sight),
        source_(source),
        work_(work),
        rise_{dot(eye.normal, quad.a), dot(eye.normal, quad.b), dot(eye.normal, quad.c)} {}

  Sum sum() {
    const int n = params_.samples;
    Sum total{};
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        total += add({(i + 0.5) / n, (j + 0.5) / n, 1.0 / n, 1.0 / n}, params_.halvings);
    return total;
  }

 private:
  Sum add(const Delta& delta, int halvings) {
    work_[renderer::Op::delta_area] += 1;
    const Vec point = find_aim(quad_, delta);
    const Vec way = point - eye_.at;
    const double square = dot(way, way);
    if (halvings > 0) {
      const double along = delta.along * delta.along * quad_.along;
      const double across = delta.across * delta.across * quad_.across;
      const double wide = std::max(along, across);
      if (wide > enough_ * square)
        return sight_.misses(point, std::sqrt(along + across) / 2)
                   ? Sum{}
                   : add_parts(delta, 2 * along > wide, 2 * across > wide, halvings - 1);
    }
    const double here = dot(eye_.normal, way), there = -dot(quad_.normal, way);
    if (here <= 0 || there <= 0 || !sight_.sees(point)) return Sum{};
    return eval_seen(delta, way, square, here, there);
  }

  // The term of a delta area that is `way` off.
  Sum eval_seen(const Delta& delta, const Vec& way, double square, double here, double there) {
    const DeltaSize size(quad_, delta);
    if constexpr (std::same_as<Source, Glow>) work_[renderer::Op::glow_found] += 1;
    if (std::max(size.square_a, size.square_b) > square)
      return eval_delta(size.area, square, here, there) * source_.eval(delta.s, delta.t);
    return eval_far(quad_, delta, size, rise_, way, square, here, there, source_);
  }

  // The sum over the parts of a delta area that is halved along, across, or both.
  Sum add_parts(const Delta& delta, bool along, bool across, int halvings) {
    const double step = along ? delta.along / 4 : 0, rise = across ? delta.across / 4 : 0;
    const double width = along ? delta.along / 2 : delta.along;
    const double height = across ? delta.across / 2 : delta.across;
    Sum total{};
    for (int j = across ? -1 : 0; j <= (across ? 1 : 0); j += 2)
      for (int i = along ? -1 : 0; i <= (along ? 1 : 0); i += 2)
        total += add({delta.s + i * step, delta.t + j * rise, width, height}, halvings);
    return total;
  }

  const FactorParams& params_;
  double enough_;
  const Viewpoint& eye_;
  const Quad& quad_;
  const Sight& sight_;
  const Source& source_;
  renderer::Work& work_;
  Rise<double> rise_;
};

/// Whether a part of the patch is in front of the viewpoint, and the viewpoint in front of it.
inline bool face_each_other(const Viewpoint& eye, const Patch& patch) {
  if (dot(patch.normal, eye.at - patch.centre) <= 0) return false;
  for (const Vec& corner : patch.at)
    if (dot(eye.normal, corner - eye.at) > 0) return true;
  return false;
}

}  // namespace radiosity
