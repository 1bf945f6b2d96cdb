#pragma once
// How far a picture is from the reference, with the reference's own noise taken out.

#include "tests/reference/path_tracer.hpp"

namespace radiosity::reference {

/// Share of the reference from which on a pixel is off.
inline constexpr double OFF = 0.15;

/// How far a picture is off. A colour counts as the mean of its components; pixels that show a lamp
/// or nothing do not count. The error of a pixel is relative to the reference there (to 2 % of the
/// mean where that is more), and e^2 becomes max(0, e^2 - s^2), s the reference's standard error.
struct Deviation {
  double rmse = 0;   ///< root mean square of differences, relative to the mean radiosity
  double bias = 0;   ///< mean of differences, likewise; negative: too dark
  double noise = 0;  ///< root mean square of the reference's standard error, likewise
  double p99 = 0;    ///< 99th percentile of the errors of pixels within a face (find_inner)
  double worst = 0;  ///< the largest of these
  double edges = 0;  ///< 99th percentile of the errors of the other pixels, at faces' borders
  int group = 0;     ///< pixels in the largest group that is off, neighbours by edge or corner
};

/// Leaves out the pixels whose ray from the eye passes an edge of a face so near that single
/// precision does not tell the side (Embree's): from then on they show nothing.
void leave_out_edges(Reference& reference, const Room& room);

/// For each pixel whether it shows something that does not emit and its neighbours all show the
/// same, by Reference::faces.
std::vector<bool> find_inner(const Reference& reference);

/// For each pixel that does not emit whether its error, less two standard errors, is OFF or more.
std::vector<bool> find_off(const Picture& picture, const Reference& reference);

/// The size of the largest group of pixels that are marked.
int count_largest_group(const std::vector<bool>& marked, int width);

/// BadInput if the sizes differ.
Deviation compare(const Picture& picture, const Reference& reference);

/// The error of each pixel as a colour: red is too bright, blue too dark, in full from `full` on;
/// what emits, and nothing, is black, and what agrees white.
Picture draw_deviation(const Picture& picture, const Reference& reference, double full);

}  // namespace radiosity::reference
