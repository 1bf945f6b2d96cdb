#pragma once
// Conversion of radiosity to the bytes of pictures.

#include "renderer/radiosity/show/picture.hpp"

namespace radiosity {

/// Display parameters: a pixel is 255 * min(1, exposure * radiosity) ^ (1 / gamma), rounded.
struct Display {
  /// value of a pixel with radiosity 1 before `gamma` applies, > 0; 0: automatic (see fit())
  double exposure = 0;
  double gamma = 2.2;  ///< exponent gamma of the display, > 0
};

/// Makes the fields exposure and gamma.
base::Fields<Display> display_fields();

/// The exposure that brings the quantile `share` of the pixels' largest components to 1. If that
/// quantile is 0, the maximum becomes 1. The exposure is 1 if all pixels are black. Pixels in
/// `left_out` (see find_emitters()) are ignored, unless these are all pixels. An empty list ignores
/// none.
double find_exposure(const Picture& picture, const std::vector<bool>& left_out = {},
                     double share = 0.99);

/// Sets an automatic exposure to find_exposure() of the pixels that are not in `left_out`.
Display fit(Display display, const Picture& picture, const std::vector<bool>& left_out);

/// The difference |a - b| times a factor, pixel by pixel. Throws BadInput if the sizes differ.
Picture make_difference(const Picture& a, const Picture& b, double factor = 1);

/// Converts to rows from the top, 3 bytes per pixel. Negative values and NaN become 0.
std::vector<std::uint8_t> make_rgb8(const Picture& picture, const Display& display);
/// Writes a PNG as renderer::save_png does. Throws BadInput unless exposure and gamma are positive.
void save_png(const std::string& path, const Picture& picture, const Display& display);
/// Writes an OpenEXR file with linear R, G, B as 32-bit floats, rows from the top, uncompressed.
/// The bytes depend only on the picture. Throws as save_png() does.
void save_exr(const std::string& path, const Picture& picture);

}  // namespace radiosity
