#pragma once
// A patch cut into delta areas, as a point sees it: the sum of Eq 3.8.

#include <numbers>

#include "renderer/radiosity/form_factor.hpp"

namespace radiosity {

/// A patch by its parameters: p + s a + t b + s t c.
struct Quad {
  Quad(const Mesh& mesh, const Patch& patch) : normal(patch.normal) {
    const auto at = [&](std::size_t k) { return mesh.vertices[patch.corners[k]].at; };
    p = at(0);
    a = at(1) - p;
    b = at(3) - p;
    c = at(2) - at(1) - b;
  }
  Vec eval(double s, double t) const { return p + s * a + t * (b + s * c); }
  /// Area for each unit of s and t.
  double eval_density(double s, double t) const { return dot(normal, cross(a + t * c, b + s * c)); }
  Vec p, a, b, c, normal;
};

/// A point that looks, and the normal of the surface that it lies on.
struct Viewpoint {
  Vec at, normal;
};

/// Each term of Eq 3.8 with A_2/N: of a delta area at a squared distance, the cosines times the
/// distance.
inline double eval_delta(double area, double square, double here, double there) {
  return here * there / square * area / (std::numbers::pi * square + area);
}

/// The sum over a patch. `is_seen(point)` says whether the viewpoint sees a point of the patch.
template <class IsSeen>
class DeltaAreas {
 public:
  DeltaAreas(const FactorParams& params, const Viewpoint& eye, const Quad& quad,
             const IsSeen& is_seen, renderer::Work& work)
      : params_(params),
        eye_(eye),
        quad_(quad),
        is_seen_(is_seen),
        enough_(params.spread * params.spread),
        work_(work) {}

  double sum() {
    const int n = params_.samples;
    double total = 0;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i)
        total += add((i + 0.5) / n, (j + 0.5) / n, 1.0 / n, params_.halvings);
    return total;
  }

 private:
  // The delta area around (s, t), of this share of the patch's sides.
  double add(double s, double t, double side, int halvings) {
    work_[renderer::Op::delta_area] += 1;
    const Vec point = quad_.eval(s, t);
    const double area = side * side * quad_.eval_density(s, t);
    const Vec way = point - eye_.at;
    const double square = dot(way, way);
    if (halvings > 0 && area > enough_ * square) {
      const double step = side / 4;
      double total = 0;
      for (const double v : {t - step, t + step})
        for (const double u : {s - step, s + step}) total += add(u, v, side / 2, halvings - 1);
      return total;
    }
    const double here = dot(eye_.normal, way), there = -dot(quad_.normal, way);
    if (here <= 0 || there <= 0 || !is_seen_(point)) return 0;
    return eval_delta(area, square, here, there);
  }

  const FactorParams& params_;
  const Viewpoint& eye_;
  const Quad& quad_;
  const IsSeen& is_seen_;
  const double enough_;  // of a delta area over its distance's square
  renderer::Work& work_;
};

/// Whether any of the patch is before the viewpoint, and the viewpoint before the patch.
inline bool face_each_other(const Mesh& mesh, const Viewpoint& eye, const Patch& patch) {
  if (dot(patch.normal, eye.at - patch.centre) <= 0) return false;
  for (const auto corner : patch.corners)
    if (dot(eye.normal, mesh.vertices[corner].at - eye.at) > 0) return true;
  return false;
}

}  // namespace radiosity
