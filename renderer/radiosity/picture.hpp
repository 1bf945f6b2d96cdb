#pragma once
// The second pass: a picture of a room whose illumination is known (thesis, 1.2.3 and 3.2.4).

#include "renderer/radiosity/form_factor.hpp"
#include "renderer/radiosity/reconstruct.hpp"

namespace radiosity {

/// Linear colours, rows from the top.
struct Picture {
  int width = 0, height = 0;
  std::vector<Rgb> pixels;  ///< at y * width + x
  bool operator==(const Picture&) const = default;
};

struct PictureParams {
  int width = 320, height = 240;  ///< pixels
  int samples = 1;                ///< rays a pixel, samples x samples in a regular grid
  int depth = 8;                  ///< mirrors that a ray may meet
};

/// The simplified ray tracer: a ray reflects in mirrors and takes the illumination of the diffuse
/// patch it meets; no feelers, no shading. What it meets from behind, and nothing, is black.
Picture trace_picture(const Mesh& mesh, const Illumination& illumination,
                      const renderer::View& view, const PictureParams& params,
                      renderer::Work& work);

/// The same from a z-buffer: patches as flat shaded or bilinearly shaded quads, mirrors grey.
Picture preview_picture(const Mesh& mesh, const Illumination& illumination,
                        const renderer::View& view, const PictureParams& params);

/// How radiosity becomes a pixel's value: 255 * min(1, exposure * radiosity) ^ (1 / gamma).
struct Display {
  double exposure = 1;  ///< > 0
  double gamma = 2.2;   ///< > 0
};
/// The exposure at which the brightest of a share of the pixels, 0.99, is just not cut off.
double find_exposure(const Picture& picture, double share = 0.99);

/// |a - b| times a factor, pixel by pixel, not negative. Sizes must be equal.
Picture make_difference(const Picture& a, const Picture& b, double factor = 1);

std::vector<std::uint8_t> make_rgb8(const Picture& picture, const Display& display);
/// As renderer::save_png.
void save_png(const std::string& path, const Picture& picture, const Display& display);
/// 32-bit linear red, green, blue; written as save_png does, with its errors. The same bytes for
/// the same picture.
void save_exr(const std::string& path, const Picture& picture);

}  // namespace radiosity
