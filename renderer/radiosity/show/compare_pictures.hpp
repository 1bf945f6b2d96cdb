#pragma once
// Errors of a picture compared with a reference picture, over the whole picture and along a line.
#include "renderer/radiosity/show/display.hpp"

namespace radiosity {

/// Relative errors: the root mean square of the difference, divided by the root mean square of the
/// reference. The error of a peak is the difference of the maxima, divided by the maximum of the
/// reference. Along the line, only the red component counts.
struct PictureError {
  double image = 0;                              ///< error of the radiosity over all pixels
  double line = 0, line_peak = 0;                ///< errors of displayed values along the line
  double line_linear = 0, line_peak_linear = 0;  ///< errors of radiosity along the line
  int peak_shift = 0;  ///< distance of the picture's peak from the reference's, in pixels
};

/// The pixels to be compared.
struct Compared {
  std::vector<bool> left_out;  ///< by pixel: true if it shows an emitter
  int line = 0;                ///< row of the line, counted from the top
  /// Limits of the search for the peak, as fractions of the width.
  double peak_from = 0, peak_to = 1;
};

/// Compares two pictures of equal size.
PictureError compare_pictures(const Picture& picture, const Picture& reference,
                              const Display& display, const Compared& where);

/// Converts the colours of a picture to displayed values, 0..1.
Picture make_displayed(const Picture& picture, const Display& display);

}  // namespace radiosity
