#pragma once
// Errors of a picture against a reference, over the whole picture and along a line.
#include "renderer/radiosity/show/display.hpp"

namespace radiosity {

/// An error is the root mean square of the difference over that of the reference. A peak's error is
/// the difference of the maxima over the reference's maximum. Along the line only red counts.
struct PictureError {
  double image = 0;                              ///< of all pixels' radiosity
  double line = 0, line_peak = 0;                ///< of displayed values, 0..255
  double line_linear = 0, line_peak_linear = 0;  ///< of radiosity
  int peak_shift = 0;                            ///< pixels, from the reference's peak
};

/// The compared pixels.
struct Compared {
  std::vector<bool> left_out;         ///< by pixel: true if it shows an emitter
  int line = 0;                       ///< from the top
  double peak_from = 0, peak_to = 1;  ///< part of the width to search for a peak
};

/// The pictures must have equal sizes.
PictureError compare_pictures(const Picture& picture, const Picture& reference,
                              const Display& display, const Compared& where);

/// The displayed values, 0..1.
Picture make_displayed(const Picture& picture, const Display& display);

}  // namespace radiosity
