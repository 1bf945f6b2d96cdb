#pragma once
// Convergence of a growing picture towards its final quality.

#include <span>

namespace renderer {

/// The state of the picture from time_s on.
struct QualityPoint {
  double time_s = 0;
  double rays = 0;     ///< rays traced so far
  double work = 0;     ///< work done so far, in any unit
  double quality = 0;  ///< quality, such as ssim() with the last picture
};

/// Summary of the curve of quality over time_s, rays or work. Positions are in the unit of that
/// axis.
struct QualityFigures {
  double area = 0;   ///< mean quality from 0 to the last point
  double to_50 = 0;  ///< position from which on quality is at least 50 % of the final one
  double to_90 = 0, to_99 = 0;
};

/// Evaluates the curve of quality over `axis`. It is a step function: each value holds until the
/// next point, and is 0 before the first. If the last point lies at 0, the area is its quality.
/// Throws BadInput, with the point, for no points, values that are not finite, a negative or
/// decreasing `axis`, or a final quality <= 0.
QualityFigures eval_quality_curve(std::span<const QualityPoint> points,
                                  double QualityPoint::*axis = &QualityPoint::time_s);

}  // namespace renderer
