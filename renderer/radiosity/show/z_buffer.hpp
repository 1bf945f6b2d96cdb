#pragma once
// A z-buffer of convex polygons with two parameters, seen from a view.

#include <array>
#include <span>
#include <vector>

#include "renderer/scene/scene.hpp"

namespace radiosity {

/// The nearest surface at a pixel so far.
struct Fragment {
  enum class Kind : std::uint8_t { nothing, back, patch, mirror };
  Kind kind = Kind::nothing;
  std::uint32_t patch = 0;
  double nearness = 0;  ///< 1 over the distance ahead
  double s = 0, t = 0;
};

/// Samples at the pixels' centres.
class ZBuffer {
 public:
  struct Point {
    renderer::Vec at;
    double s = 0, t = 0;
  };

  /// The view has its image plane.
  ZBuffer(const renderer::View& view, int width, int height);

  /// Draws a convex polygon of 3 corners or more, either side. The nearest wins; of what coincides
  /// the first, but any other kind before a back. In each triangle from the first corner s and t
  /// are linear in space.
  void draw(Fragment::Kind kind, std::uint32_t patch, std::span<const Point> corners);

  /// At y * width + x; rows run from the top.
  const std::vector<Fragment>& fragments() const { return fragments_; }

 private:
  struct Rectangle {
    int left, top, right, bottom;  // right and bottom excluded
  };
  using Triangle = std::array<Point, 3>;

  Rectangle bound(const Triangle& points) const;
  void draw(const Fragment& what, const Triangle& points);

  const renderer::View view_;
  const int width_, height_;
  const double step_;  // width of a pixel at distance 1
  std::vector<Fragment> fragments_;
};

}  // namespace radiosity
