#pragma once
// Deviation of a picture from the reference, corrected for the reference's own noise.

#include "tests/reference/path_tracer.hpp"

namespace radiosity::reference {

/// Relative error from which a pixel is off.
inline constexpr double OFF = 0.15;

/// Deviation of a picture. A colour counts as the mean of its components; pixels that show a lamp
/// or nothing do not count. A pixel's error is relative to the reference there (at least to 2 % of
/// the mean). e^2 is replaced by max(0, e^2 - s^2); s is the reference's standard error.
struct Deviation {
  double rmse = 0;   ///< root mean square of differences, relative to the mean radiosity
  double bias = 0;   ///< mean of differences, likewise; negative: too dark
  double noise = 0;  ///< root mean square of the reference's standard error, likewise
  double p99 = 0;    ///< 99th percentile of the errors of pixels within a face (find_inner)
  double worst = 0;  ///< largest of these errors
  double edges = 0;  ///< 99th percentile of the errors of the other pixels, at faces' borders
  int group = 0;     ///< pixels in the largest group that is off, neighbours by edge or corner
};

/// Excludes pixels whose ray passes an edge of a face too closely for single precision (Embree's)
/// to tell the side: these pixels then show nothing.
void leave_out_edges(Reference& reference, const Room& room);

/// For each pixel: whether it shows a face that does not emit, and all its neighbours show the
/// same, by Reference::faces.
std::vector<bool> find_inner(const Reference& reference);

/// For each pixel that does not emit: whether its error, less two standard errors, is at least OFF.
std::vector<bool> find_off(const Picture& picture, const Reference& reference);

/// The size of the largest group of marked pixels.
int count_largest_group(const std::vector<bool>& marked, int width);

/// Throws BadInput if the sizes differ.
Deviation compare(const Picture& picture, const Reference& reference);

/// The error of each pixel as a colour: red is too bright, blue too dark, saturated from `full` on.
/// Emitting and empty pixels are black, exact ones white.
Picture draw_deviation(const Picture& picture, const Reference& reference, double full);

}  // namespace radiosity::reference
