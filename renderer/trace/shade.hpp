#pragma once
// T. Whitted's shading (1980) in the incremental form of the thesis, 4.3. A ray carries its
// influence factor, so that its contribution to its sample depends only on the ray and its hit.

#include <optional>
#include <vector>

#include "renderer/trace/sampling.hpp"

namespace renderer {

/// A point of the image plane, which is at distance 1 from the view point. It is given by its
/// offsets along the view's `right` and `above` from the centre.
struct PlanePoint {
  double right = 0, above = 0;
};
/// Position of the sample of pixel (x, y), with y downwards.
PlanePoint make_plane_point(const View& view, const Params& params, int x, int y);

/// Makes the ray of sample `pass` of pixel (x, y). If a pixel has a single sample, it lies at
/// `params.sample`. Several samples are spread over a square of one pixel's size, whose centre or
/// upper left corner is this position. The origins of rays are spread over the lens, and their
/// times over the shutter's time.
Ray make_primary(const View& view, const Params& params, int x, int y, int pass = 0);
/// Makes the ray through the upper left corner of pixel (x, y), from the centre of the lens, at
/// half the shutter's time. Its hit helps to find the borders of objects. `x` may be the image's
/// width, and `y` its height. Ray::path is y * (width + 1) + x, and Ray::sample is a pixel with
/// this corner.
Ray make_probe(const View& view, const Params& params, int x, int y);

using Children = std::vector<Ray>;

/// Appends to `out` the children of `ray` at its hit, within the limits, in this order: a shadow
/// feeler (ray to a light) for every light (thesis Eq 4.17), the reflected ray if ks > 0, and the
/// transmitted ray if t > 0 (Eq 4.15). Feelers and probes have no children. On total internal
/// reflection, the transmitted ray is mirrored; it is omitted if `params.total_reflection` is
/// `lost` and the surface is clear. A feeler goes to the point of the light that the sample uses. A
/// ray from a surface with gloss or translucency goes to a point of a disc, or to the mirror image
/// of that point if it is on the wrong side of the surface.
void make_children(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                   Children& out, Work& work);
/// Appends the children without the shadow feelers.
void make_branches(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                   Children& out, Work& work);

/// The colour, including texture, of the surface where `ray` hits it. The texture is filtered
/// isotropically over the size of a pixel at the hit: the path's length from the eye, multiplied by
/// the pixel's angle and divided by the cosine. With several samples per pixel, the texture is
/// filtered over half this size, regardless of the number of samples.
Rgb colour_of(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit, Work& work);

/// The contribution of `ray` to its sample (thesis Eq 4.26), multiplied by weight_of(). A shadow
/// feeler that is not blocked contributes fS * IS, a blocked one contributes nothing (Eq 4.27). Any
/// other ray contributes f * ka * Ia if it hits a surface, and f * background if it does not (Eq
/// 4.28).
Rgb eval_contribution(const Scene& scene, const Params& params, const Ray& ray,
                      const std::optional<Hit>& hit, Work& work);

/// Mirrors `direction` at a surface with the unit normal `normal`.
Vec reflect(const Vec& direction, const Vec& normal);
/// Refracts `direction` at a surface with the unit normal `normal`, which points to the side of the
/// incoming ray. The index of refraction grows by the factor `ratio`. Returns none on total
/// internal reflection.
std::optional<Vec> refract(const Vec& direction, const Vec& normal, double ratio);

}  // namespace renderer
