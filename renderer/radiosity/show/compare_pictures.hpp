#pragma once
// How far a picture is from a reference, all over and along a line.
#include "renderer/radiosity/show/display.hpp"

namespace radiosity {

/// An error is the root mean square of the difference over that of the reference; a peak's is the
/// difference of the largest values over the reference's. Along the line only red counts.
struct PictureError {
  double image = 0;                              ///< of all pixels' radiosity
  double line = 0, line_peak = 0;                ///< of displayed values, 0..255
  double line_linear = 0, line_peak_linear = 0;  ///< of radiosity
  int peak_shift = 0;                            ///< pixels, from the reference's peak
};

/// The pixels that are compared.
struct Compared {
  std::vector<bool> left_out;         ///< by pixel: what emits
  int line = 0;                       ///< from the top
  double peak_from = 0, peak_to = 1;  ///< part of the width in which a peak is looked for
};

/// The pictures must have one size.
PictureError compare_pictures(const Picture& picture, const Picture& reference,
                              const Display& display, const Compared& where);

/// The values that the display shows, 0..1.
Picture make_displayed(const Picture& picture, const Display& display);

}  // namespace radiosity
