#pragma once
// Convergence of a picture's quality while the picture is computed.

#include <span>

namespace renderer {

/// The state of the picture from time_s until the next point.
struct QualityPoint {
  double time_s = 0;
  double rays = 0;     ///< rays traced so far
  double work = 0;     ///< work done so far, in a unit of the caller's choice
  double quality = 0;  ///< quality, such as ssim() with the final picture
};

/// Summary of the curve of quality over time_s, rays or work. Positions have the unit of this axis.
struct QualityFigures {
  double area = 0;  ///< mean quality from position 0 to the last point
  /// Position from which the quality stays at or above 50 % of the final quality.
  double to_50 = 0;
  double to_90 = 0, to_99 = 0;
};

/// Evaluates the curve of quality over `axis`. The curve is a step function: each value holds until
/// the next point, and the quality is 0 before the first point. If the last point is at position 0,
/// the area is its quality. Throws BadInput that names the point if there are no points, if a value
/// is not finite, if `axis` is negative or decreases, or if the final quality is not positive.
QualityFigures eval_quality_curve(std::span<const QualityPoint> points,
                                  double QualityPoint::*axis = &QualityPoint::time_s);

}  // namespace renderer
