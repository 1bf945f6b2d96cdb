#pragma once
// How far a picture is from the reference picture, corrected for the noise of the reference.

#include "tests/reference/path_tracer.hpp"

namespace radiosity::reference {

/// A pixel counts as wrong if its relative error is at least this.
inline constexpr double OFF = 0.15;

/// Deviation of a picture from the reference. A colour counts as the mean of its components. Pixels
/// that show a lamp or nothing are ignored. The error e of a pixel is relative to the value of the
/// reference there, or to 2 % of the reference's mean if that is more. In sums, e^2 is replaced by
/// max(0, e^2 - s^2), where s is the reference's standard error.
struct Deviation {
  double rmse = 0;  ///< root mean square of the differences, relative to the mean radiosity
  /// mean of the differences, relative to the mean radiosity; negative if the picture is too dark
  double bias = 0;
  /// root mean square of the reference's standard errors, relative to the mean radiosity
  double noise = 0;
  /// 99th percentile of the errors of pixels in the interior of a face (see find_inner)
  double p99 = 0;
  double worst = 0;  ///< largest error of a pixel in the interior of a face
  /// 99th percentile of the errors of the other pixels, which are at the borders of faces
  double edges = 0;
  int group = 0;  ///< number of pixels in the largest connected group of wrong pixels
};

/// Excludes pixels whose ray passes so close to an edge that Embree's single precision cannot tell
/// on which side of the edge. These pixels count as showing nothing.
void leave_out_edges(Reference& reference, const Room& room);

/// For each pixel: true if it shows a face that does not emit, and all its neighbours show this
/// face too (see Reference::faces).
std::vector<bool> find_inner(const Reference& reference);

/// For each pixel that does not emit: true if its error, less two standard errors, is at least OFF.
std::vector<bool> find_off(const Picture& picture, const Reference& reference);

/// The number of pixels in the largest connected group of marked pixels; diagonal neighbours count.
int count_largest_group(const std::vector<bool>& marked, int width);

/// Compares a picture with the reference. Throws BadInput if their sizes differ.
Deviation compare(const Picture& picture, const Reference& reference);

/// Draws the error of each pixel as a colour: red where the picture is too bright, blue where it is
/// too dark. From the error `full` on, the colour is saturated. Pixels that emit or show nothing
/// are black, and exact ones are white.
Picture draw_deviation(const Picture& picture, const Reference& reference, double full);

}  // namespace radiosity::reference
