// Triangles in homogeneous coordinates, which need no clipping: M. Olano and T. Greer, "Triangle
// Scan Conversion using 2D Homogeneous Coordinates", Graphics Hardware 1997.

#include "renderer/radiosity/show/z_buffer.hpp"

namespace radiosity {

using renderer::Vec;

namespace {

// Least distance ahead at which the bounds of a triangle are found, a share of its largest
// coordinate: it may reach behind the eye.
constexpr double NEAR = 1e-9;
// Share of the nearness by which a front is preferred to a back at the same place.
constexpr double COINCIDENT = 1e-9;

// Replaces what is nearer; of what coincides a front replaces a back.
void put(Fragment& there, const Fragment& found) {
  using Kind = Fragment::Kind;
  if (!(found.nearness > 0)) return;
  const bool over = there.kind == Kind::back && found.kind != Kind::back,
             under = found.kind == Kind::back && there.kind != Kind::back;
  const double worth = over ? 1 + COINCIDENT : under ? 1 - COINCIDENT : 1;
  if (found.nearness * worth > there.nearness) there = found;
}

}  // namespace

ZBuffer::ZBuffer(const renderer::View& view, int width, int height)
    : view_(view),
      width_(width),
      height_(height),
      step_(2 * view.half_height / height),
      fragments_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height)) {}

void ZBuffer::draw(Fragment::Kind kind, std::uint32_t patch, std::span<const Point> corners) {
  std::vector<Point> points(corners.begin(), corners.end());
  for (Point& p : points) {
    const Vec way = p.at - view_.from;
    p.at = {dot(way, view_.right), dot(way, view_.above), dot(way, view_.ahead)};
  }
  for (std::size_t i = 2; i < points.size(); ++i)
    draw({kind, patch}, {points[0], points[i - 1], points[i]});
}

// The pixels whose centres the triangle may cover.
ZBuffer::Rectangle ZBuffer::bound(const Triangle& points) const {
  double far = 0;
  for (const Point& p : points) far = std::max(far, max_abs(p.at));
  const double near = NEAR * far;
  double left = width_, top = height_, right = 0, bottom = 0;
  const auto add = [&](const Vec& p) {
    const double x = p.x / p.z / step_ + width_ / 2.0, y = height_ / 2.0 - p.y / p.z / step_;
    left = std::min(left, x), right = std::max(right, x);
    top = std::min(top, y), bottom = std::max(bottom, y);
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec &a = points[i].at, &b = points[(i + 1) % 3].at;
    if (a.z >= near) add(a);
    if ((a.z < near) != (b.z < near)) {
      Vec cut = a + ((near - a.z) / (b.z - a.z)) * (b - a);
      cut.z = near;
      add(cut);
    }
  }
  const auto clip = [](double at, int most) {
    return static_cast<int>(std::clamp(at, 0.0, static_cast<double>(most)));
  };
  return {clip(std::floor(left - 0.5), width_), clip(std::floor(top - 0.5), height_),
          clip(std::ceil(right + 0.5), width_), clip(std::ceil(bottom + 0.5), height_)};
}

void ZBuffer::draw(const Fragment& what, const Triangle& p) {
  // For a way (x, y, 1), edge i is 0 along the side across from corner i. Shared sides agree to
  // the last bit.
  const std::array<Vec, 3> edges = {cross(p[1].at, p[2].at), cross(p[2].at, p[0].at),
                                    cross(p[0].at, p[1].at)};
  const double volume = dot(p[0].at, edges[0]);
  if (volume == 0) return;
  const double sign = volume < 0 ? -1 : 1;
  const Rectangle box = bound(p);
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x) {
      const Vec way{(x + 0.5 - width_ / 2.0) * step_, (height_ / 2.0 - y - 0.5) * step_, 1};
      const double e0 = sign * dot(edges[0], way), e1 = sign * dot(edges[1], way),
                   e2 = sign * dot(edges[2], way);
      if (!(e0 >= 0 && e1 >= 0 && e2 >= 0)) continue;
      const double sum = e0 + e1 + e2;
      Fragment found = what;
      found.nearness = sum / (sign * volume);
      found.s = (e0 * p[0].s + e1 * p[1].s + e2 * p[2].s) / sum;
      found.t = (e0 * p[0].t + e1 * p[1].t + e2 * p[2].t) / sum;
      put(fragments_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                     static_cast<std::size_t>(x)],
          found);
    }
}

}  // namespace radiosity
