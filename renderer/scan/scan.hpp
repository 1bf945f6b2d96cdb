#pragma once
// Scan conversion of polygons (finding the pixels that they cover) for a z-buffer (thesis, 1.1.4).

#include <array>
#include <vector>

#include "renderer/trace/raster.hpp"

namespace renderer {

/// Coordinates of a point relative to the eye, along the view's axes: right, above and ahead.
inline Vec to_eye(const View& view, const Vec& at) {
  const Vec way = at - view.from;
  return {dot(way, view.right), dot(way, view.above), dot(way, view.ahead)};
}

/// Scan converter. Finds the samples of an image that a polygon covers, and interpolates N values
/// linearly.
template <std::size_t N>
class Scanner {
 public:
  using Values = std::array<double, N>;
  struct Corner {
    Vec at;  ///< position as returned by to_eye()
    Values values{};
  };

  /// Limits the scan conversion to the samples in `area`.
  Scanner(const Raster& raster, const Area& area) : raster_(raster), area_(area) {}

  /// Calls put(x, y, nearness, values) for each sample in a polygon, whose inside is defined by the
  /// even-odd rule. `nearness` is 1 / depth. The part behind the eye is cut off. Values are
  /// interpolated along the edges and then along the scan line (H. Gouraud, 1971), which is linear
  /// in triangles. Polygons that share an edge in front of the eye neither share samples nor leave
  /// a gap.
  template <class Put>
  void scan(const std::vector<Corner>& corners, const Put& put) {
    project(corners, find_near(corners));
    if (spots_.size() < 3) return;
    double top = spots_[0].y, bottom = top;
    for (const Spot& spot : spots_) top = std::min(top, spot.y), bottom = std::max(bottom, spot.y);
    const int first = clip_up(top, area_.y, area_.height);
    const int end = clip_up(bottom, area_.y, area_.height);
    for (int y = first; y < end; ++y) scan_line(y, put);
  }

  /// Calls put(x, y, nearness, values) along the line from `a` to `b`: once for each column that it
  /// crosses, or for each row if it crosses more rows. The part behind the eye is cut off.
  template <class Put>
  void draw_line(const Corner& a, const Corner& b, const Put& put) {
    project({a, b}, 1e-9 * std::max(max_abs(a.at), max_abs(b.at)));
    if (spots_.size() < 2) return;
    const auto [from, to] = std::minmax(spots_[0], spots_[1], [](const Spot& p, const Spot& q) {
      return p.x < q.x || (p.x == q.x && p.y < q.y);
    });
    const bool steep = std::abs(to.y - from.y) > to.x - from.x;
    const double Spot::*axis = steep ? &Spot::y : &Spot::x;
    const Spot &low = from.*axis <= to.*axis ? from : to, &high = &low == &from ? to : from;
    const int start = steep ? area_.y : area_.x, length = steep ? area_.height : area_.width;
    const int first = clip_up(low.*axis - 0.5, start, length),
              end = clip_up(high.*axis + 0.5, start, length);
    for (int at = first; at < end; ++at) {
      const double span = high.*axis - low.*axis;
      const double share = span > 0 ? std::clamp((at - low.*axis) / span, 0.0, 1.0) : 0;
      const Spot spot = mix(low, high, share);
      const double across = std::floor((steep ? spot.x : spot.y) + 0.5);
      const int from_across = steep ? area_.x : area_.y;
      if (!(across >= from_across && across < from_across + (steep ? area_.width : area_.height)))
        continue;
      const int other = static_cast<int>(across);
      tell(spot, steep ? other : at, steep ? at : other, put);
    }
  }

 private:
  // A point in the image. Its values have been multiplied by 1 / depth, which makes them linear in
  // the image.
  struct Spot {
    double x, y;      // in pixels; (0, 0) is the first sample
    double nearness;  // 1 / depth
    Values values;
  };

  // The smallest integer that is at least `at`, clamped to `start`..`start + length`.
  static int clip_up(double at, int start, int length) {
    return static_cast<int>(
        std::ceil(std::clamp(at, static_cast<double>(start), static_cast<double>(start + length))));
  }

  static Spot mix(const Spot& a, const Spot& b, double share) {
    const auto between = [&](double p, double q) { return p + share * (q - p); };
    Spot spot{between(a.x, b.x), between(a.y, b.y), between(a.nearness, b.nearness), {}};
    for (std::size_t i = 0; i < N; ++i) spot.values[i] = between(a.values[i], b.values[i]);
    return spot;
  }

  void add_spot(const Corner& corner) {
    const double nearness = 1 / corner.at.z;
    Spot spot{raster_.left + corner.at.x * nearness / raster_.step,
              raster_.top - corner.at.y * nearness / raster_.step, nearness, corner.values};
    for (double& value : spot.values) value *= nearness;
    spots_.push_back(spot);
  }

  // The depth of the near plane at which polygons are cut off: half the smallest depth at which a
  // sample can meet the polygon's plane. Nothing visible is lost, and harmful rounding close to the
  // eye is avoided. 0 if the polygon's plane is seen edge-on.
  double find_near(const std::vector<Corner>& corners) const {
    Vec normal, middle;
    for (const Corner& c : corners) middle += (1.0 / static_cast<double>(corners.size())) * c.at;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++)
      normal += cross(corners[j].at - middle, corners[i].at - middle);
    // In the direction `way` = (x, y, 1), the depth of the plane is dot(normal, middle) /
    // dot(normal, way). The divisor is largest at a corner of the area.
    double most = 0;
    for (const int x : {area_.x, area_.x + area_.width})
      for (const int y : {area_.y, area_.y + area_.height})
        most = std::max(most, std::abs(dot(normal, Vec{(x - raster_.left) * raster_.step,
                                                       (raster_.top - y) * raster_.step, 1})));
    return most > 0 ? 0.5 * std::abs(dot(normal, middle)) / most : 0;
  }

  // Fills `spots_` with the corners whose depth is at least `near`, and with the points where edges
  // cross the near plane.
  void project(const std::vector<Corner>& corners, double near) {
    spots_.clear();
    if (!(near > 0)) return;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
      const Corner &a = corners[j], &b = corners[i];
      if ((a.at.z < near) != (b.at.z < near)) {
        const Corner &behind = a.at.z < near ? a : b, &ahead = a.at.z < near ? b : a;
        const double share = (near - behind.at.z) / (ahead.at.z - behind.at.z);
        Corner cut{behind.at + share * (ahead.at - behind.at), {}};
        cut.at.z = near;
        for (std::size_t k = 0; k < N; ++k)
          cut.values[k] = behind.values[k] + share * (ahead.values[k] - behind.values[k]);
        add_spot(cut);
      }
      if (b.at.z >= near) add_spot(b);
    }
  }

  template <class Put>
  void scan_line(int y, const Put& put) {
    crossings_.clear();
    const Spot* last = &spots_.back();
    for (const Spot& spot : spots_) {
      if ((spot.y < y) != (last->y < y)) {
        // Orders the ends of an edge from top to bottom. Two polygons with a common edge then
        // compute the same crossings of the edge, to the last bit.
        const Spot &a = spot.y < y ? spot : *last, &b = spot.y < y ? *last : spot;
        crossings_.push_back(mix(a, b, (y - a.y) / (b.y - a.y)));
      }
      last = &spot;
    }
    std::ranges::sort(crossings_, {}, &Spot::x);
    for (std::size_t i = 1; i < crossings_.size(); i += 2) {
      const Spot &a = crossings_[i - 1], &b = crossings_[i];
      const int first = clip_up(a.x, area_.x, area_.width),
                end = clip_up(b.x, area_.x, area_.width);
      for (int x = first; x < end; ++x) tell(mix(a, b, (x - a.x) / (b.x - a.x)), x, y, put);
    }
  }

  template <class Put>
  static void tell(const Spot& spot, int x, int y, const Put& put) {
    Values values = spot.values;
    for (double& value : values) value /= spot.nearness;
    put(x, y, spot.nearness, values);
  }

  const Raster raster_;
  const Area area_;
  std::vector<Spot> spots_, crossings_;
};

}  // namespace renderer
