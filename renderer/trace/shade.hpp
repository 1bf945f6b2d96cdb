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

/// The ray of sample `pass` of pixel (x, y). The only sample of a pixel lies at `params.sample`;
/// several are spread over the pixel whose upper left corner or middle this is. Ray origins spread
/// over the lens, and times over the shutter's.
Ray make_primary(const View& view, const Params& params, int x, int y, int pass = 0);
/// The ray through the upper left corner of pixel (x, y), from the middle of the lens, at half the
/// shutter's time. Its hit helps to find objects' borders. `x` may be the image's width and `y` its
/// height. The path is y * (width + 1) + x, and the sample is a pixel with this corner.
Ray make_probe(const View& view, const Params& params, int x, int y);

using Children = std::vector<Ray>;

/// Appends to `out` the children of `ray` at its hit, within the limits, in this order. They are a
/// shadow feeler to every light (Eq 4.17), the reflected ray if ks > 0, and the transmitted one if
/// t > 0 (Eq 4.15); none from a feeler or a probe. On total internal reflection the transmitted ray
/// is mirrored if the surface has translucency, else omitted. Feelers go to the sample's point of
/// the light. Rays from surfaces with gloss and translucency go to a point of a disc, or to its
/// mirror image if the point is on the wrong side of the surface.
void make_children(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                   Children& out, Work& work);
/// The same without shadow feelers.
void make_branches(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                   Children& out, Work& work);

/// The surface's colour where `ray` hits it, with its texture. The texture is filtered
/// isotropically over the size of a pixel there (half of it with several samples, whatever their
/// number): the path from the eye times the pixel's angle, divided by the cosine.
Rgb colour_of(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit, Work& work);

/// The contribution of `ray` to its sample (Eq 4.26), times weight_of(). An unblocked feeler has fS
/// * IS, a blocked one nothing (Eq 4.27). Any other ray has f * ka * Ia, or f * background if it
/// hits nothing (Eq 4.28).
Rgb eval_contribution(const Scene& scene, const Params& params, const Ray& ray,
                      const std::optional<Hit>& hit, Work& work);

/// `direction` mirrored at a surface of unit `normal`.
Vec reflect(const Vec& direction, const Vec& normal);
/// `direction` refracted at a surface of unit `normal` (towards the incoming ray) if the index of
/// refraction grows by the factor `ratio`; none on total internal reflection.
std::optional<Vec> refract(const Vec& direction, const Vec& normal, double ratio);

}  // namespace renderer
