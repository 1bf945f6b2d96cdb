#pragma once
// Speed at which a picture approaches its final quality.

#include <span>

namespace renderer {

/// The picture displayed from this time on.
struct QualityPoint {
  double time_s = 0;
  double rays = 0;     ///< traced so far
  double work = 0;     ///< done so far, in any unit
  double quality = 0;  ///< such as ssim() with the last picture
};

/// Figures of the curve of quality over time_s, rays or work; times are in the unit of that axis.
struct QualityFigures {
  double area = 0;   ///< mean quality from 0 to the last point
  double to_50 = 0;  ///< from here on quality is at least 50 % of the last point's
  double to_90 = 0, to_99 = 0;
};

/// Quality is a step function: each point's value holds until the next point; 0 before the first.
/// If the last point lies at 0, the area is its quality. BadInput, with the point, for no points,
/// for values that are not finite, for a negative or falling `axis`, or a final quality <= 0.
QualityFigures eval_quality_curve(std::span<const QualityPoint> points,
                                  double QualityPoint::*axis = &QualityPoint::time_s);

}  // namespace renderer
