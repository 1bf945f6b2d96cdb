#pragma once
// The second pass: a picture of a room whose illumination is known (thesis, 1.2.3 and 3.2.4).

#include "renderer/radiosity/light/form_factor.hpp"
#include "renderer/radiosity/show/reconstruct.hpp"

namespace radiosity {

/// Linear colours, rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;  ///< at y * width + x
  bool operator==(const Picture&) const = default;
};

struct PictureParams {
  int width = 320, height = 240;  ///< pixels, 1..65536 each and 2^28 together
  int samples = 1;  ///< rays a pixel, samples x samples in a regular grid, 1..64; 1: its centre
  int depth = 8;    ///< mirrors that a ray may meet, 0..1000
};

/// std::invalid_argument naming the field, what was found and what was expected.
void check(const PictureParams& params);

/// The view with what renderer::finish() derives; BadInput for an impossible one.
renderer::View make_image_plane(const renderer::View& view);

/// The simplified ray tracer: a ray reflects in mirrors and takes the illumination of the diffuse
/// patch it meets; no feelers, no shading. What it meets from behind, and nothing, is black, and
/// so is a mirror at the end of `depth`. Throws as check() and make_image_plane(). Adds to `work`:
/// one Op::sample_updated a ray from the eye, one Op::ray_reflected a mirror met.
Picture trace_picture(const Mesh& mesh, const Illumination& illumination,
                      const renderer::View& view, const PictureParams& params,
                      renderer::Work& work);

/// The same from a z-buffer, without mirrors: these are as grey as the room's patches are on
/// average. One sample a pixel. Equal but at the edges of faces, where patches are parallelograms;
/// in others (s, t) is linear in each of two triangles.
Picture preview_picture(const Mesh& mesh, const Illumination& illumination,
                        const renderer::View& view, const PictureParams& params);

/// How radiosity becomes a pixel's value: 255 * min(1, exposure * radiosity) ^ (1 / gamma),
/// rounded.
struct Display {
  double exposure = 1;  ///< > 0
  double gamma = 2.2;   ///< > 0
};
/// The exposure at which the brightest of a share of the pixels, 0.99, is just not cut off: their
/// largest component is 1. Of the whole picture if these are black, and 1 if it is all black.
double find_exposure(const Picture& picture, double share = 0.99);

/// |a - b| times a factor, pixel by pixel. std::invalid_argument if the sizes differ.
Picture make_difference(const Picture& a, const Picture& b, double factor = 1);

/// Rows from the top, 3 bytes a pixel; what is negative or no number is 0.
std::vector<std::uint8_t> make_rgb8(const Picture& picture, const Display& display);
/// As renderer::save_png. std::invalid_argument for an exposure or a gamma that is not above 0.
void save_png(const std::string& path, const Picture& picture, const Display& display);
/// An OpenEXR file of linear R, G, B, 32-bit floats, rows from the top, not compressed; written as
/// save_png does, with its errors. The same bytes for the same picture: no date, no text.
void save_exr(const std::string& path, const Picture& picture);

}  // namespace radiosity
