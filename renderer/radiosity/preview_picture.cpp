// preview_picture(): a z-buffer. Triangles in homogeneous coordinates are not clipped: M. Olano
// and T. Greer, "Triangle Scan Conversion using 2D Homogeneous Coordinates", Graphics Hardware
// 1997.

#include "renderer/radiosity/picture.hpp"
#include "renderer/shade.hpp"

namespace radiosity {

namespace {

// In the camera's coordinates: right, above, ahead. Nothing nearer than this share of the largest
// distance to a corner is drawn.
constexpr double NEAR = 1e-9;
// Of a front over a back at the same place, relative.
constexpr double COINCIDENT = 1e-9;

// What is seen at a pixel: the nearest so far.
struct Fragment {
  enum class Kind : std::uint8_t { nothing, back, patch, mirror };
  double nearness = 0;  // 1 over the distance ahead
  Kind kind = Kind::nothing;
  std::uint32_t patch = 0;
  double s = 0, t = 0;
};

struct Point {
  Vec at;  // camera coordinates
  double s = 0, t = 0;
};

struct Rectangle {
  int left, top, right, bottom;  // right and bottom excluded
};

class Raster {
 public:
  Raster(const renderer::View& view, const PictureParams& params)
      : view_(view),
        width_(params.width),
        height_(params.height),
        step_(2 * view.half_height / params.height),
        fragments_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {}

  const std::vector<Fragment>& fragments() const { return fragments_; }

  void draw(const Fragment& what, std::span<const Vec> corners, std::span<const Point> flat) {
    std::vector<Point> points(flat.begin(), flat.end());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec way = corners[i] - view_.from;
      points[i].at = {dot(way, view_.right), dot(way, view_.above), dot(way, view_.ahead)};
    }
    for (std::size_t i = 2; i < points.size(); ++i)
      draw(what, {points[0], points[i - 1], points[i]});
  }

 private:
  // A pixel's column or row, not rounded.
  double column(double right) const { return right / step_ + width_ / 2.0; }
  double row(double above) const { return height_ / 2.0 - above / step_; }

  // Of the pixels whose centres the triangle may cover.
  Rectangle bound(const std::array<Point, 3>& points) const {
    double far = 0;
    for (const Point& p : points) far = std::max(far, max_abs(p.at));
    const double near = NEAR * far;
    double left = width_, top = height_, right = 0, bottom = 0;
    const auto add = [&](const Vec& p) {
      const double x = column(p.x / p.z), y = row(p.y / p.z);
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

  void draw(const Fragment& what, const std::array<Point, 3>& p) {
    // Of a way (x, y, 1): edge i is 0 along the side across from corner i. Shared sides agree to
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

  // Nearest wins, and of what coincides a front over a back.
  static void put(Fragment& there, const Fragment& found) {
    using Kind = Fragment::Kind;
    if (!(found.nearness > 0)) return;
    const bool over = there.kind == Kind::back && found.kind != Kind::back,
               under = found.kind == Kind::back && there.kind != Kind::back;
    const double worth = over ? 1 + COINCIDENT : under ? 1 - COINCIDENT : 1;
    if (found.nearness * worth > there.nearness) there = found;
  }

  const renderer::View& view_;
  const int width_, height_;
  const double step_;  // of a pixel at distance 1
  std::vector<Fragment> fragments_;
};

// Of the patches, by area.
Rgb make_grey(const Mesh& mesh, const Illumination& illumination) {
  double sum = 0, area = 0;
  for (std::uint32_t i = 0; i < mesh.patches.size(); ++i) {
    const Rgb middle = eval_illumination(illumination, i, 0.5, 0.5);
    sum += mesh.patches[i].area * (middle.r + middle.g + middle.b) / 3;
    area += mesh.patches[i].area;
  }
  const double grey = area > 0 ? sum / area : 0;
  return {grey, grey, grey};
}

}  // namespace

Picture preview_picture(const Mesh& mesh, const Illumination& illumination,
                        const renderer::View& view, const PictureParams& params) {
  using Kind = Fragment::Kind;
  check(params);
  const renderer::View eye = make_view(view);
  Raster raster(eye, params);
  const auto side = [&](const Vec& normal, const Vec& corner, Kind front) {
    return dot(normal, eye.from - corner) > 0 ? front : Kind::back;
  };
  const std::array<Point, 4> unit = {{{{}, 0, 0}, {{}, 1, 0}, {{}, 1, 1}, {{}, 0, 1}}};
  for (std::uint32_t i = 0; i < mesh.patches.size(); ++i) {
    const Patch& patch = mesh.patches[i];
    std::array<Vec, 4> corners;
    for (std::size_t k = 0; k < 4; ++k) corners[k] = mesh.vertices[patch.corners[k]].at;
    raster.draw({0, side(patch.normal, corners[0], Kind::patch), i}, corners, unit);
  }
  for (const Mirror& mirror : mesh.mirrors)
    raster.draw({0, side(mirror.normal, mirror.corners[0], Kind::mirror)}, mirror.corners,
                std::vector<Point>(mirror.corners.size()));
  const Rgb grey = make_grey(mesh, illumination);
  Picture picture{params.width, params.height, {}};
  for (const Fragment& f : raster.fragments())
    picture.pixels.push_back(f.kind == Kind::patch
                                 ? eval_illumination(illumination, f.patch, f.s, f.t)
                             : f.kind == Kind::mirror ? grey
                                                      : Rgb{});
  return picture;
}

}  // namespace radiosity
