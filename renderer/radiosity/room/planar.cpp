#include "renderer/radiosity/room/planar.hpp"

namespace radiosity {

double eval_distance(const Vec& point, const Vec& a, const Vec& b) {
  const Vec along = b - a;
  const double square = dot(along, along);
  const double t = square > 0 ? std::clamp(dot(point - a, along) / square, 0.0, 1.0) : 0;
  return length(point - lerp(a, b, t));
}

Vec eval_mean(std::span<const Vec> corners) {
  Vec sum;
  for (const Vec& corner : corners) sum += corner;
  return (1.0 / static_cast<double>(corners.size())) * sum;
}

Vec eval_centre(std::span<const Vec> corners) {
  Vec sum;
  for (const Vec& corner : corners) sum += (1.0 / static_cast<double>(corners.size())) * corner;
  return sum;
}

std::vector<Vec> clip(std::span<const Vec> polygon, const Plane& plane, double tolerance) {
  std::vector<double> heights;
  bool above = false;
  for (const Vec& corner : polygon) {
    const double height = eval_height(plane, corner);
    heights.push_back(std::abs(height) <= tolerance ? 0 : height);
    above = above || heights.back() > 0;
  }
  std::vector<Vec> part;
  if (!above) return part;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::size_t next = (i + 1) % polygon.size();
    const double here = heights[i], there = heights[next];
    if (here >= 0) part.push_back(polygon[i]);
    if ((here > 0 && there < 0) || (here < 0 && there > 0))
      part.push_back(lerp(polygon[i], polygon[next], here / (here - there)));
  }
  return part;
}

std::optional<std::array<Vec, 2>> cut(std::span<const Vec> polygon, const Plane& plane) {
  std::array<Vec, 2> ends;
  std::size_t found = 0;
  double here = eval_height(plane, polygon.back());
  const Vec* last = &polygon.back();
  for (const Vec& corner : polygon) {
    const double there = eval_height(plane, corner);
    if ((here > 0) != (there > 0) && found < 2)
      ends[found++] = lerp(*last, corner, here / (here - there));
    here = there;
    last = &corner;
  }
  if (found < 2) return std::nullopt;
  return ends;
}

std::vector<Plane> make_edge_planes(std::span<const Vec> polygon, const Vec& normal) {
  std::vector<Plane> planes;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec& a = polygon[i];
    const Vec inward = cross(normal, polygon[(i + 1) % polygon.size()] - a);
    if (dot(inward, inward) == 0) continue;
    planes.push_back(make_plane(normalize(inward), a));
  }
  return planes;
}

bool Interval::keep_positive(double here, double there) {
  if (here < 0 && there < 0) return false;
  if (here < 0) from = std::max(from, here / (here - there));
  if (there < 0) to = std::min(to, here / (here - there));
  return true;
}

std::optional<Interval> clip_segment(const Vec& a, const Vec& b, std::span<const Plane> planes,
                                     double margin) {
  Interval part;
  for (const Plane& plane : planes)
    if (!part.keep_positive(eval_height(plane, a) - margin, eval_height(plane, b) - margin))
      return std::nullopt;
  if (part.from >= part.to) return std::nullopt;
  return part;
}

}  // namespace radiosity
