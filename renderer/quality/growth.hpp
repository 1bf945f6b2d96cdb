#pragma once
// How fast a picture becomes what it will be.

#include <span>

namespace renderer {

/// The picture on display from now on.
struct GrowthPoint {
  double time_s = 0;
  double rays = 0;     ///< traced until now
  double work = 0;     ///< done until now, in any unit
  double quality = 0;  ///< such as ssim() with the last picture
};

/// Figures of a curve of quality over one of time_s, rays and work; in that one's unit.
struct Growth {
  double area = 0;   ///< mean quality from 0 to the last point
  double to_50 = 0;  ///< from when on quality never is less than 50 % of the last point's
  double to_90 = 0, to_99 = 0;
};

/// Quality is a step: a point's holds until the next one, and is 0 before the first. Where the last
/// point lies at 0, the area is its quality. BadInput naming the point, for none, values that
/// are no numbers, a negative or falling `axis`, or no quality above 0 at the end.
Growth eval_growth(std::span<const GrowthPoint> points,
                   double GrowthPoint::*axis = &GrowthPoint::time_s);

}  // namespace renderer
