#pragma once
// From radiosity to the bytes of pictures.

#include "renderer/radiosity/show/picture.hpp"

namespace radiosity {

/// How radiosity becomes a pixel's value: 255 * min(1, exposure * radiosity) ^ (1 / gamma),
/// rounded.
struct Display {
  double exposure = 0;  ///< pixel's value at radiosity 1, before gamma, > 0; 0: see fit()
  double gamma = 2.2;   ///< exponent of the display, > 0
};

/// The fields exposure and gamma.
base::Fields<Display> display_fields();

/// The exposure at which the brightest of a share of the pixels is just not cut off: its largest
/// component becomes 1. If these are black, the brightest of all counts; 1 if it is black. Pixels
/// that are `left_out` (find_emitters) do not count, unless all are; none are if it is empty.
double find_exposure(const Picture& picture, const std::vector<bool>& left_out = {},
                     double share = 0.99);

/// `display` with the exposure that shows best what is not `left_out`, where it has none.
Display fit(Display display, const Picture& picture, const std::vector<bool>& left_out);

/// |a - b| times a factor, pixel by pixel. BadInput if the sizes differ.
Picture make_difference(const Picture& a, const Picture& b, double factor = 1);

/// Rows from the top, 3 bytes a pixel; a value that is negative or no number becomes 0.
std::vector<std::uint8_t> make_rgb8(const Picture& picture, const Display& display);
/// Writes as renderer::save_png. BadInput for an exposure or a gamma that is not above 0.
void save_png(const std::string& path, const Picture& picture, const Display& display);
/// An OpenEXR file of linear R, G, B, 32-bit floats, rows from the top, not compressed; written as
/// save_png() does, with its errors. The bytes depend on the picture only: no date, no text.
void save_exr(const std::string& path, const Picture& picture);

}  // namespace radiosity
