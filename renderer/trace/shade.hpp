#pragma once
// T. Whitted's shading (1980) in the incremental form of the thesis, 4.3. A ray carries its
// influence factor, so that its contribution to its sample follows from the ray and its hit.

#include <optional>
#include <vector>

#include "renderer/trace/sampling.hpp"

namespace renderer {

/// A point of the image plane at distance 1 from the view point: its offsets along the view's
/// `right` and `above` from the axis `ahead`.
struct PlanePoint {
  double right = 0, above = 0;
};
/// Position of the sample of pixel (x, y); y grows downwards.
PlanePoint make_plane_point(const View& view, const Params& params, int x, int y);

/// Makes the ray of sample `pass` of pixel (x, y). A single sample of a pixel lies at
/// `params.sample`. Several samples are spread over a square of one pixel's size, whose middle or
/// upper left corner is this position. Ray origins are spread over the lens, and times over the
/// shutter's time.
Ray make_primary(const View& view, const Params& params, int x, int y, int pass = 0);
/// Makes the ray through the upper left corner of pixel (x, y), from the middle of the lens, at
/// half the shutter's time. Its hit helps to find borders of objects. `x` may be the image's width
/// and `y` its height. Ray::path is y * (width + 1) + x, and Ray::sample is a pixel with this
/// corner.
Ray make_probe(const View& view, const Params& params, int x, int y);

using Children = std::vector<Ray>;

/// Appends to `out` the children of `ray` at its hit, within the limits, in this order: a shadow
/// feeler to every light (Eq 4.17), the reflected ray if ks > 0, and the transmitted ray if t > 0
/// (Eq 4.15). Feelers and probes have no children. On total internal reflection, the transmitted
/// ray is mirrored, or omitted if `params.total_reflection` is `lost` and the surface is clear.
/// Feelers go to the sample's point of the light. Rays from surfaces with gloss and translucency go
/// to a point of a disc, or to its mirror image if it is on the wrong side of the surface.
void make_children(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                   Children& out, Work& work);
/// Appends the children without shadow feelers.
void make_branches(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                   Children& out, Work& work);

/// The surface's colour where `ray` hits it, with its texture. The texture is filtered
/// isotropically over the size of a pixel there: the path from the eye times the pixel's angle,
/// divided by the cosine. With several samples it is half that size, whatever their number.
Rgb colour_of(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit, Work& work);

/// The contribution of `ray` to its sample (Eq 4.26), times weight_of(). An unblocked feeler
/// contributes fS * IS, a blocked one nothing (Eq 4.27). Any other ray contributes f * ka * Ia, or
/// f * background if it hits nothing (Eq 4.28).
Rgb eval_contribution(const Scene& scene, const Params& params, const Ray& ray,
                      const std::optional<Hit>& hit, Work& work);

/// `direction` mirrored at a surface with the unit vector `normal`.
Vec reflect(const Vec& direction, const Vec& normal);
/// `direction` refracted at a surface with the unit vector `normal` (towards the incoming ray), if
/// the index of refraction grows by the factor `ratio`. None on total internal reflection.
std::optional<Vec> refract(const Vec& direction, const Vec& normal, double ratio);

}  // namespace renderer
