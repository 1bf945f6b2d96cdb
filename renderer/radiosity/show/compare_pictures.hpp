#pragma once
// Errors of a picture against a reference, over the whole picture and along a line.
#include "renderer/radiosity/show/display.hpp"

namespace radiosity {

/// An error is the root mean square of the difference, divided by the root mean square of the
/// reference. The error of a peak is the difference of the maxima, divided by the reference's
/// maximum. Along the line, only red counts.
struct PictureError {
  double image = 0;                              ///< error of radiosity over all pixels
  double line = 0, line_peak = 0;                ///< errors of displayed values along the line
  double line_linear = 0, line_peak_linear = 0;  ///< errors of radiosity along the line
  int peak_shift = 0;  ///< displacement of the peak from the reference's, pixels
};

/// The pixels to compare.
struct Compared {
  std::vector<bool> left_out;         ///< for each pixel: true if it shows an emitter
  int line = 0;                       ///< row of the line, counted from the top
  double peak_from = 0, peak_to = 1;  ///< limits of the search for the peak, as shares of the width
};

/// Compares two pictures of equal size.
PictureError compare_pictures(const Picture& picture, const Picture& reference,
                              const Display& display, const Compared& where);

/// Converts a picture to displayed values, 0..1.
Picture make_displayed(const Picture& picture, const Display& display);

}  // namespace radiosity
