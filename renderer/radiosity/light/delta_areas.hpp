#pragma once
// Subdivision of a patch into small parts, the delta areas, as seen from a point. The light at the
// point is the sum of thesis Eq 3.8 over them.
//
// The formulas are templates over the number type: a double, or several numbers in SIMD lanes
// (renderer/scene/lanes.hpp).

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "renderer/radiosity/mesh/mesh.hpp"
#include "renderer/scene/lanes.hpp"
#include "renderer/scene/work.hpp"

namespace radiosity {

/// A patch as a bilinear function of the parameters s and t, from 0 to 1: p + s a + t b + s t c.
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
  /// Area per unit of s and t at the point (s, t).
  template <class Number>
  [[gnu::always_inline]] Number eval_density(const Number& s, const Number& t) const {
    return density + s * by_s + t * by_t;
  }
  Vec p, a, b, c, normal;
  double along, across;        // squared length of the longer one of two opposite sides
  double density, by_s, by_t;  // eval_density() at (0, 0), and its derivatives by s and t
  double aa, ac, bb, bc, cc;   // dot products of a, b and c
};

/// A point that receives light, with the surface normal there.
struct Viewpoint {
  Vec at, normal;
};

/// One term of thesis Eq 3.8. `area` is A_2/N in the equation, and `square` is the squared
/// distance. `here` and `there` are the cosines at the viewpoint and at the delta area, each
/// multiplied by the distance.
inline double eval_delta(double area, double square, double here, double there) {
  return here * there / square * area / (std::numbers::pi * square + area);
}

/// One side of a delta area, seen from a distant viewpoint. All values are measured at the middle
/// of the delta area. `way` is the vector from the viewpoint to this middle.
template <class Number, class Share>
struct DeltaSide {
  Number turn;    ///< component of the side along `way`, divided by the length of `way`
  Number rise;    ///< component along the viewpoint's normal, divided by that of `way`
  Number square;  ///< squared length of the side, divided by the squared distance
  Share growth;   ///< relative change, along this side, of the length of the other side

  /// The contribution of this side to eval_extent() of the delta area.
  [[gnu::always_inline]] Number eval_extent() const {
    return turn * (turn - 1.0 / 3 * rise) - 1.0 / 6 * square +
           1.0 / 12 * growth * (rise - 4.0 * turn);
  }
  /// Distance along this side from the centre of the delta area to the centroid of its form factor,
  /// as a fraction of the side, to first order.
  [[gnu::always_inline]] Number eval_drift() const {
    using renderer::clamp, std::clamp;
    return clamp(1.0 / 12 * (growth + rise - 4.0 * turn), -0.5, 0.5);
  }
};

/// Relative correction for the size of a delta area. Its form factor is that of a point with the
/// same area, multiplied by 1 + eval_extent(). The remaining error is of the fourth power of side
/// over distance. The correction consists of the second derivatives of Eq 3.8 along the sides,
/// divided by 24, and of the shift of area towards the end where the other side is longer.
template <class Number, class Share>
[[gnu::always_inline]] inline Number eval_extent(const DeltaSide<Number, Share>& a,
                                                 const DeltaSide<Number, Share>& b) {
  return a.eval_extent() + b.eval_extent();
}

/// A patch with the constant radiosity 1.
struct Even {
  static constexpr bool IS_EVEN = true;
  template <class Number>
  [[gnu::always_inline]] static double eval(const Number&, const Number&) {
    return 1;
  }
};

/// A part of a patch, centred at the parameters (s, t). Its sides are fractions of the patch's
/// sides.
template <class Share>
struct DeltaOf {
  Share s, t, along, across;
};
using Delta = DeltaOf<double>;

/// The point of a delta area that visibility rays aim at, slightly off its centre. In symmetric
/// rooms, especially between two mirrors, lines between centres would pass exactly through edges.
/// Rounding would then decide on which side of an edge a line passes.
[[gnu::always_inline]] inline Vec find_aim(const Quad& quad, const Delta& delta) {
  constexpr double ASIDE = 0.7e-6, ABOVE = 1.1e-6;
  return quad.eval(delta.s + ASIDE * delta.along, delta.t + ABOVE * delta.across);
}

/// Measures of a delta area at its middle.
template <class Share>
struct DeltaSize {
  [[gnu::always_inline]] DeltaSize(const Quad& quad, const DeltaOf<Share>& delta)
      : density(quad.eval_density(delta.s, delta.t)),
        area(delta.along * delta.across * density),
        square_a(delta.along * delta.along *
                 (quad.aa + delta.t * (2.0 * quad.ac + delta.t * quad.cc))),
        square_b(delta.across * delta.across *
                 (quad.bb + delta.s * (2.0 * quad.bc + delta.s * quad.cc))) {}
  Share density, area;
  Share square_a, square_b;  ///< squared lengths of the sides
};

/// Dot products of a viewpoint's normal with a, b and c of a Quad.
template <class Number>
struct Rise {
  Number a, b, c;
};

/// The form factor of a delta area whose sides are shorter than its distance, multiplied by the
/// radiosity `source.eval(s, t)`. The result is exact to second order in side over distance. `way`
/// is the vector from the viewpoint to the delta area; `square` is its squared length; `here` and
/// `there` are as in eval_delta(). Share is the number type for one or several delta areas. Vector
/// and Number are the types for one or several viewpoints.
template <class Share, class Vector, class Number, class Source>
[[gnu::always_inline]] inline auto eval_far(const Quad& quad, const DeltaOf<Share>& delta,
                                            const DeltaSize<Share>& size, const Rise<Number>& rise,
                                            const Vector& way, const Number& square,
                                            const Number& here, const Number& there,
                                            const Source& source) {
  const auto [s, t, along, across] = delta;
  // Computes reciprocals only once, because divisions dominate the cost.
  const Number per_square = 1.0 / square, per_here = 1.0 / here;
  const Share per_density = 1.0 / size.density;
  const Number way_c = dot(way, quad.c);
  const DeltaSide<Number, Share> a{per_square * along * (dot(way, quad.a) + t * way_c),
                                   per_here * along * (rise.a + t * rise.c),
                                   per_square * size.square_a, per_density * along * quad.by_s};
  const DeltaSide<Number, Share> b{per_square * across * (dot(way, quad.b) + s * way_c),
                                   per_here * across * (rise.b + s * rise.c),
                                   per_square * size.square_b, per_density * across * quad.by_t};
  const Number extent = eval_extent(a, b);
  const Number factor = std::numbers::inv_pi * here * there * size.area * (per_square * per_square);
  const Number term = extent > 0.0 ? factor * (1.0 + extent) : factor / (1.0 - extent);
  const Number at_s = s + a.eval_drift() * along, at_t = t + b.eval_drift() * across;
  return term * source.eval(at_s, at_t);
}

/// How to divide a patch into samples x samples delta areas. A delta area is halved, up to
/// `halvings` times, while it is wider than sqrt(enough) times its distance from the viewpoint.
struct Cut {
  int samples, halvings;
  double enough;
};

/// A delta area as seen from a viewpoint that faces it.
struct Look {
  Vec point, way;      ///< point returned by find_aim(), and vector to it from the viewpoint
  double square;       ///< squared distance from the viewpoint
  double here, there;  ///< cosines multiplied by the distance, as in eval_delta()
};

/// Divides a patch and calls `take(delta, look)` for each delta area that faces the viewpoint.
/// `misses(point, radius)` may return true only if the viewpoint sees no point of the patch within
/// `radius` of `point`; such parts are not divided further.
template <class Misses, class Take>
class Cutter {
 public:
  Cutter(const Cut& cut, const Viewpoint& eye, const Quad& quad, const Misses& misses,
         const Take& take, renderer::Work& work)
      : cut_(cut), eye_(eye), quad_(quad), misses_(misses), take_(take), work_(work) {}

  void run() {
    const int n = cut_.samples;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        add({(i + 0.5) / n, (j + 0.5) / n, 1.0 / n, 1.0 / n}, cut_.halvings);
  }

 private:
  void add(const Delta& delta, int halvings) {
    work_[renderer::Op::delta_area] += 1;
    Look look;
    look.point = find_aim(quad_, delta);
    look.way = look.point - eye_.at;
    look.square = dot(look.way, look.way);
    if (halvings > 0) {
      const double along = delta.along * delta.along * quad_.along;
      const double across = delta.across * delta.across * quad_.across;
      const double wide = std::max(along, across);
      if (wide > cut_.enough * look.square) {
        if (!misses_(look.point, std::sqrt(along + across) / 2))
          add_parts(delta, 2 * along > wide, 2 * across > wide, halvings - 1);
        return;
      }
    }
    look.here = dot(eye_.normal, look.way);
    look.there = -dot(quad_.normal, look.way);
    if (look.here > 0 && look.there > 0) take_(delta, look);
  }

  // Adds the two or four parts of a delta area that is halved along, across, or both.
  void add_parts(const Delta& delta, bool along, bool across, int halvings) {
    const double step = along ? delta.along / 4 : 0, rise = across ? delta.across / 4 : 0;
    const double width = along ? delta.along / 2 : delta.along;
    const double height = across ? delta.across / 2 : delta.across;
    for (int j = across ? -1 : 0; j <= (across ? 1 : 0); j += 2)
      for (int i = along ? -1 : 0; i <= (along ? 1 : 0); i += 2)
        add({delta.s + i * step, delta.t + j * rise, width, height}, halvings);
  }

  Cut cut_;
  const Viewpoint& eye_;
  const Quad& quad_;
  const Misses& misses_;
  const Take& take_;
  renderer::Work& work_;
};

/// True if a delta area is wider than its distance from the viewpoint. Eq 3.8 is then used instead
/// of eval_far().
inline bool is_wide(const DeltaSize<double>& size, double square) {
  return std::max(size.square_a, size.square_b) > square;
}

/// The type of a sum of form factors multiplied by `source.eval(s, t)`: a number or a colour.
template <class Source>
using SumOf = decltype(1.0 * std::declval<Source>().eval(0, 0));

/// The form factor of a visible delta area, multiplied by the radiosity `source.eval(s, t)`. It
/// follows Eq 3.8 if the delta area is wide. Otherwise it is exact to second order in side over
/// distance. (Eq 3.8 is derived for a disc that faces the viewpoint; alone, it would lose 0.3 % of
/// the light of a room.)
template <class Source>
SumOf<Source> eval_seen(const Quad& quad, const Delta& delta, const Vec& normal, const Look& look,
                        const Source& source, renderer::Work& work) {
  const DeltaSize size(quad, delta);
  if constexpr (!Source::IS_EVEN) work[renderer::Op::glow_found] += 1;
  if (is_wide(size, look.square))
    return eval_delta(size.area, look.square, look.here, look.there) *
           source.eval(delta.s, delta.t);
  const Rise<double> rise{dot(normal, quad.a), dot(normal, quad.b), dot(normal, quad.c)};
  return eval_far(quad, delta, size, rise, look.way, look.square, look.here, look.there, source);
}

/// The sum of eval_seen() over the visible part of a patch. `sight.sees(point)` returns whether the
/// viewpoint sees a point of the patch. See Cutter for `sight.misses(point, radius)`.
template <class Sight, class Source>
SumOf<Source> sum_deltas(const Cut& cut, const Viewpoint& eye, const Quad& quad, const Sight& sight,
                         const Source& source, renderer::Work& work) {
  SumOf<Source> total{};
  const auto misses = [&](const Vec& point, double radius) { return sight.misses(point, radius); };
  const auto take = [&](const Delta& delta, const Look& look) {
    if (sight.sees(look.point)) total += eval_seen(quad, delta, eye.normal, look, source, work);
  };
  Cutter(cut, eye, quad, misses, take, work).run();
  return total;
}

}  // namespace radiosity
