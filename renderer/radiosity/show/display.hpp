#pragma once
// Conversion of radiosity to the bytes of pictures.

#include "renderer/radiosity/show/picture.hpp"

namespace radiosity {

/// Display parameters: a pixel is 255 * min(1, exposure * radiosity) ^ (1 / gamma), rounded.
struct Display {
  double exposure = 0;  ///< pixel's value at radiosity 1, before gamma, > 0; 0: see fit()
  double gamma = 2.2;   ///< exponent of the display, > 0
};

/// The fields exposure and gamma.
base::Fields<Display> display_fields();

/// The exposure that just does not clip a fraction `share` of the pixels: the largest component of
/// the brightest of them becomes 1. If these are black, the brightest of all counts; 1 if it is
/// black. Ignores pixels that are `left_out` (find_emitters), unless all are; empty: ignores none.
double find_exposure(const Picture& picture, const std::vector<bool>& left_out = {},
                     double share = 0.99);

/// `display`, with find_exposure() of the pixels not `left_out` if it has no exposure.
Display fit(Display display, const Picture& picture, const std::vector<bool>& left_out);

/// a - b| times a factor, pixel by pixel. BadInput if the sizes differ.
Picture make_difference(const Picture& a, const Picture& b, double factor = 1);

/// Rows from the top, 3 bytes a pixel; negative values and NaN become 0.
std::vector<std::uint8_t> make_rgb8(const Picture& picture, const Display& display);
/// Writes like renderer::save_png. BadInput for an exposure or a gamma that is not above 0.
void save_png(const std::string& path, const Picture& picture, const Display& display);
/// An OpenEXR file of linear R, G, B, 32-bit floats, rows from the top, uncompressed; written like
/// save_png(), with its errors. The bytes depend only on the picture: no date, no text.
void save_exr(const std::string& path, const Picture& picture);

}  // namespace radiosity
