#include "renderer/quality/quality_curve.hpp"

#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr const char* WHO = "growth";

// The first position on `axis` from which the quality stays at or above `least`. The last point
// must reach `least`.
double find_time(std::span<const QualityPoint> points, double QualityPoint::*axis, double least) {
  std::size_t first = points.size() - 1;
  while (first > 0 && points[first - 1].quality >= least) --first;
  return points[first].*axis;
}

}  // namespace

QualityFigures eval_quality_curve(std::span<const QualityPoint> points,
                                  double QualityPoint::*axis) {
  require(!points.empty(), WHO, "no point", "1 or more");
  double area = 0, before = 0, quality = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double at = points[i].*axis;
    const std::string who = fmt::format("{}, point {}", WHO, i);
    require(at >= before && std::isfinite(at), who, at,
            fmt::format("a number, {} or more", before));
    require(std::isfinite(points[i].quality), who, points[i].quality, "a quality, a number");
    area += (at - before) * quality;
    before = at;
    quality = points[i].quality;
  }
  require(quality > 0, fmt::format("{}, last point", WHO), quality, "a quality above 0");
  const auto time_to = [&](double share) { return find_time(points, axis, share * quality); };
  return {before > 0 ? area / before : quality, time_to(0.5), time_to(0.9), time_to(0.99)};
}

}  // namespace renderer
