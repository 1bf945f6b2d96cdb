#pragma once
// Deviation of a picture from the reference, corrected for the reference's own noise.

#include "tests/reference/path_tracer.hpp"

namespace radiosity::reference {

/// Relative error from which on a pixel counts as wrong.
inline constexpr double OFF = 0.15;

/// Deviation of a picture. The value of a colour is the mean of its components. Pixels that show a
/// lamp or nothing are ignored. The error of a pixel is relative to the reference's value there, or
/// to 2 % of the mean if that is more. Its square e^2 is replaced by max(0, e^2 - s^2), where s is
/// the reference's standard error.
struct Deviation {
  double rmse = 0;  ///< root mean square of the differences, relative to the mean radiosity
  double bias = 0;  ///< mean of the differences, relative to the mean radiosity; negative: too dark
  /// root mean square of the reference's standard error, relative to the mean radiosity
  double noise = 0;
  double p99 = 0;    ///< 99th percentile of the errors of pixels inside a face (find_inner)
  double worst = 0;  ///< largest error of pixels inside a face
  double edges = 0;  ///< 99th percentile of the errors of all other pixels, at borders of faces
  int group = 0;     ///< pixels in the largest group of wrong neighbours (by edge or corner)
};

/// Excludes pixels whose ray passes an edge of a face so closely that Embree's single precision
/// cannot tell the side. These pixels then show nothing.
void leave_out_edges(Reference& reference, const Room& room);

/// For each pixel, whether it shows a face that does not emit, and all its neighbours show the same
/// face (Reference::faces).
std::vector<bool> find_inner(const Reference& reference);

/// For each pixel that does not emit, whether its error, less two standard errors, is at least OFF.
std::vector<bool> find_off(const Picture& picture, const Reference& reference);

/// The size of the largest group of marked pixels.
int count_largest_group(const std::vector<bool>& marked, int width);

/// Compares a picture with the reference. Throws BadInput if the sizes differ.
Deviation compare(const Picture& picture, const Reference& reference);

/// Draws the error of each pixel as a colour: red is too bright, blue too dark, saturated from
/// `full` on. Emitting and empty pixels are black, exact ones white.
Picture draw_deviation(const Picture& picture, const Reference& reference, double full);

}  // namespace radiosity::reference
