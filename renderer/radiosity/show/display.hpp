#pragma once
// Conversion of radiosity to the displayed values of picture files.

#include "renderer/radiosity/show/picture.hpp"

namespace radiosity {

/// Parameters of the display. The value of a pixel is 255 * min(1, exposure * radiosity) ^ (1 /
/// gamma), rounded.
struct Display {
  /// Factor on the radiosity, > 0; 0: automatic (see fit()).
  double exposure = 0;
  double gamma = 2.2;  ///< gamma of the display, > 0
};

/// Makes the fields exposure and gamma.
base::Fields<Display> display_fields();

/// The exposure that maps the quantile `share` of the pixels' largest components to 1. If that
/// quantile is 0, the exposure maps the maximum to 1; if all pixels are black, it is 1. `left_out`
/// has a flag for each pixel that is ignored (see find_emitters()), unless all pixels are flagged.
/// An empty list ignores no pixel.
double find_exposure(const Picture& picture, const std::vector<bool>& left_out = {},
                     double share = 0.99);

/// Replaces an automatic exposure by find_exposure() of the pixels that are not flagged in
/// `left_out`.
Display fit(Display display, const Picture& picture, const std::vector<bool>& left_out);

/// Converts the picture to bytes: rows from the top, 3 bytes per pixel. Negative values and NaN
/// become 0.
std::vector<std::uint8_t> make_rgb8(const Picture& picture, const Display& display);
/// Writes a PNG. Throws BadInput unless exposure and gamma are positive, and as renderer::save_png
/// does.
void save_png(const std::string& path, const Picture& picture, const Display& display);

}  // namespace radiosity
