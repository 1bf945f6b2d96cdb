#pragma once
// T. Whitted's shading (1980) in the incremental form of the thesis, 4.3: a ray carries its
// influence factor, so what it adds to its sample is known from it and from what it meets.

#include <cstdint>
#include <optional>
#include <vector>

#include "renderer/trace/intersect.hpp"

namespace renderer {

/// Which lights get a feeler from an intersection.
enum class Feelers : std::uint8_t {
  all,   ///< the thesis: every light
  front  ///< the SPD: those on the side of the surface that the ray came from
};

/// Where in its pixel a sample is taken.
enum class SamplePosition : std::uint8_t {
  corner,  ///< the upper left corner
  center,
  lattice  ///< width x height samples span the view from edge to edge
};

/// When a shading tree ends.
struct Limits {
  int depth = 15;  ///< levels, 1..1000: the primary ray's is 1; a reflected or transmitted
                   ///< ray is made up to this level, a feeler at every intersection
  double min_influence = 0.0;  ///< 0..1: a reflected or transmitted ray is made when its largest
                               ///< influence factor is at least this
};

/// A rectangle of pixels; the origin is the upper left.
struct Area {
  int x = 0, y = 0;
  int width = 0, height = 0;  ///< 0 x 0: the whole image
  bool operator==(const Area&) const = default;
};

struct Params {
  int width = 100, height = 100;  ///< pixels, 1..65536 each and 2^28 together
  Limits limits;
  Feelers feelers = Feelers::all;
  SamplePosition sample = SamplePosition::corner;
  Area area;  ///< what render() computes, within the image
  Traversal traversal = Traversal::exhaustive;
  double ambient = 0.1;  ///< Ia, intensity of ambient light, 0..1000 (assumed: NFF has none)
};

/// std::invalid_argument naming the field, what was found and what was expected.
void check(const Params& params);
/// `params.area`, or the whole image.
Area get_area(const Params& params);

/// The ray through pixel (x, y) of the image; y grows downwards.
Ray make_primary(const Scene& scene, const Params& params, int x, int y);

using Children = std::vector<Ray>;

/// Appends to `out` the rays that `ray` leaves where it hits: a shadow feeler to every light
/// (Eq 4.17), then the reflected ray where ks > 0 and the transmitted one where t > 0 (Eq 4.15),
/// within the limits. Total internal reflection transmits nothing. A feeler leaves no rays.
void make_children(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                   Children& out, Work& work);

/// What `ray` adds to its sample (Eq 4.26): an unblocked feeler fS * IS, a blocked one nothing
/// (Eq 4.27); any other ray f * ka * Ia, or f * background where it hits nothing (Eq 4.28).
Rgb eval_contribution(const Scene& scene, const Params& params, const Ray& ray,
                      const std::optional<Hit>& hit, Work& work);

/// The direction of `direction` refracted at a surface of unit `normal` (towards the incoming ray)
/// when the index of refraction grows by the factor `ratio`; none on total internal reflection.
std::optional<Vec> refract(const Vec& direction, const Vec& normal, double ratio);

}  // namespace renderer
