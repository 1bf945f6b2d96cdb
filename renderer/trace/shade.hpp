#pragma once
// T. Whitted's shading (1980) in the incremental form of the thesis, 4.3: a ray carries its
// influence factor, so what it adds to its sample is known from it and from what it meets.

#include <optional>
#include <vector>

#include "renderer/trace/sampling.hpp"

namespace renderer {

/// A point of the image plane at distance 1 from the view point: how far along the view's `right`
/// and `above` it is from where `ahead` goes.
struct PlanePoint {
  double right = 0, above = 0;
};
/// Where the sample of pixel (x, y) is; y grows downwards.
PlanePoint make_plane_point(const View& view, const Params& params, int x, int y);

/// The ray of sample `pass` of pixel (x, y) of the image. A pixel that has one sample has it where
/// `params.sample` says; samples of several are spread over the pixel, whose upper left corner or
/// middle that is. Rays start all over the lens, at times all over the shutter's.
Ray make_primary(const View& view, const Params& params, int x, int y, int pass = 0);
/// The ray through the upper left corner of pixel (x, y), from the middle of the lens, when half
/// the shutter's time has passed: what it meets shows where objects' borders are.
/// `x` may be the image's width and `y` its height. The path is y * (width + 1) + x, the sample a
/// pixel of which it is a corner.
Ray make_probe(const View& view, const Params& params, int x, int y);

using Children = std::vector<Ray>;

/// Appends to `out` the rays that `ray` leaves where it hits: a shadow feeler to every light
/// (Eq 4.17), then the reflected ray where ks > 0 and the transmitted one where t > 0 (Eq 4.15),
/// within the limits; none from a feeler. On total internal reflection the transmitted ray is
/// mirrored where there is translucency, else there is none. Feelers go to a point of the light
/// that is the sample's, reflected and transmitted rays of surfaces with gloss and translucency to
/// a point of a disc; where that is on the wrong side of the surface, to its mirror image.
void make_children(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                   Children& out, Work& work);
/// The same without shadow feelers.
void make_branches(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit,
                   Children& out, Work& work);

/// The surface's colour where `ray` hits it, its texture included. The texture is filtered over
/// what a pixel covers there (with several samples, over half of its width, whatever their number):
/// the way from the eye times the pixel's angle, divided by the cosine, in all directions alike.
Rgb colour_of(const Scene& scene, const Params& params, const Ray& ray, const Hit& hit, Work& work);

/// The contribution of `ray` to its sample (Eq 4.26): fS * IS for an unblocked feeler, nothing for
/// a blocked one (Eq 4.27); for any other ray f * ka * Ia, or f * background where it hits nothing
/// (Eq 4.28). Times weight_of() its sample.
Rgb eval_contribution(const Scene& scene, const Params& params, const Ray& ray,
                      const std::optional<Hit>& hit, Work& work);

/// The direction of `direction` mirrored at a surface of unit `normal`.
Vec reflect(const Vec& direction, const Vec& normal);
/// The direction of `direction` refracted at a surface of unit `normal` (towards the incoming ray)
/// when the index of refraction grows by the factor `ratio`; none on total internal reflection.
std::optional<Vec> refract(const Vec& direction, const Vec& normal, double ratio);

}  // namespace renderer
