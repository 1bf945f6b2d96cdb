#include "renderer/scene/triangulate.hpp"

#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

// Tolerances relative to the polygon's size (OFF_PLANE) and to its square (NO_AREA).
constexpr double OFF_PLANE = 1e-6, NO_AREA = 1e-12;
constexpr const char* CROSSED = "a polygon with crossing edges";
constexpr std::size_t MOST_CORNERS = 1000;

struct Point {
  double u = 0, v = 0;
  bool operator==(const Point&) const = default;
};

double eval_size(std::span<const Vec> corners) {
  const Bounds bounds = make_bounds(corners);
  return length(bounds.hi - bounds.lo);
}

// Returns twice the signed area of the triangle abc: positive if it is counter-clockwise.
double eval_turn(const Point& a, const Point& b, const Point& c) {
  return (b.u - a.u) * (c.v - a.v) - (b.v - a.v) * (c.u - a.u);
}

// Projects the corners along the area normal, so that the front is counter-clockwise, and scales
// them to size 1.
std::vector<Point> project(std::span<const Vec> corners) {
  const double size = eval_size(corners);
  const Vec area = eval_area_normal(corners);
  require(length(area) > NO_AREA * size * size, "a polygon with area 0",
          "vertices that are not collinear");
  const Vec normal = normalize(area);
  const Vec u = normalize(cross(std::abs(normal.x) < 0.5 ? Vec{1, 0, 0} : Vec{0, 1, 0}, normal));
  const Vec v = cross(normal, u);
  std::vector<Point> points;
  for (const Vec& corner : corners) {
    const Vec from_first = (1 / size) * (corner - corners[0]);
    points.push_back({dot(from_first, u), dot(from_first, v)});
  }
  return points;
}

class EarClipper {
 public:
  explicit EarClipper(std::vector<Point> points) : points_(std::move(points)) {
    const auto count = static_cast<std::uint32_t>(points_.size());
    for (std::uint32_t i = 0; i < count; ++i)
      links_.push_back({(i + count - 1) % count, (i + 1) % count});
    for (std::uint32_t i = 0; i < count; ++i)
      if (turn(i) <= 0) reflex_.push_back(i);
    require(reflex_.empty() || count <= MOST_CORNERS,
            fmt::format("a polygon of {} corners that is neither flat nor convex", count),
            fmt::format("at most {}", MOST_CORNERS));
  }

  std::vector<Triangle> clip() {
    std::uint32_t left = static_cast<std::uint32_t>(points_.size()), at = 1;
    for (std::uint32_t failed = 0; left > 3;) {
      const bool is_all_tried = failed >= left;
      require(failed < 2 * left, CROSSED, "edges that do not cross");
      if (is_ear(at) || (is_all_tried && std::abs(turn(at)) <= NO_AREA)) {
        const auto next = links_[at].next;
        cut(at);
        --left;
        failed = 0;
        at = links_[next].next;
      } else {
        ++failed;
        at = links_[at].next;
      }
    }
    require(turn(at) >= -NO_AREA, CROSSED, "edges that do not cross");
    add(at);
    return std::move(triangles_);
  }

 private:
  struct Link {
    std::uint32_t last, next;
  };

  double turn(std::uint32_t i) const {
    return eval_turn(points_[links_[i].last], points_[i], points_[links_[i].next]);
  }

  bool is_ear(std::uint32_t i) const {
    if (turn(i) <= 0) return false;
    const Point &a = points_[links_[i].last], &b = points_[i], &c = points_[links_[i].next];
    return std::ranges::none_of(reflex_, [&](std::uint32_t other) {
      const Point& p = points_[other];
      return p != a && p != b && p != c && eval_turn(a, b, p) >= 0 && eval_turn(b, c, p) >= 0 &&
             eval_turn(c, a, p) >= 0;
    });
  }

  void add(std::uint32_t i) { triangles_.push_back({links_[i].last, i, links_[i].next}); }

  void cut(std::uint32_t i) {
    add(i);
    const auto [last, next] = links_[i];
    links_[last].next = next;
    links_[next].last = last;
    std::erase_if(reflex_, [&](std::uint32_t other) {
      return other == i || ((other == last || other == next) && turn(other) > 0);
    });
  }

  std::vector<Point> points_;
  std::vector<Link> links_;  // neighbours of the corners that are not yet cut off
  std::vector<std::uint32_t> reflex_;
  std::vector<Triangle> triangles_;
};

}  // namespace

Vec eval_area_normal(std::span<const Vec> corners) {
  // Computes relative to the first corner, because products of large coordinates would cancel.
  Vec sum;
  for (std::size_t i = 2; i < corners.size(); ++i)
    sum += cross(corners[i - 1] - corners[0], corners[i] - corners[0]);
  return sum;
}

bool is_flat(std::span<const Vec> corners) {
  const Vec area = eval_area_normal(corners);
  if (corners.size() <= 3 || area == Vec{}) return true;
  const double most = OFF_PLANE * eval_size(corners);
  const Vec normal = normalize(area);
  double mean = 0;
  for (const Vec& corner : corners) mean += dot(normal, corner - corners[0]);
  mean /= static_cast<double>(corners.size());
  return std::ranges::all_of(corners, [&](const Vec& corner) {
    return std::abs(dot(normal, corner - corners[0]) - mean) <= most;
  });
}

std::vector<Triangle> triangulate(std::span<const Vec> corners) {
  return EarClipper(project(corners)).clip();
}

}  // namespace renderer
