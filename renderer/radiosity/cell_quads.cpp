// How cells become quads.
#include "renderer/radiosity/cells.hpp"

#include <algorithm>

namespace radiosity {

namespace {

// A corner is straight where the sine of its turn is less.
constexpr double STRAIGHT = 0.17;

// Points and quads so far, and the middles of edges.
struct Quads {
  Division division;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;

  std::uint32_t add(const Vec& point) {
    division.points.push_back(point);
    return static_cast<std::uint32_t>(division.points.size() - 1);
  }
  std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
    const auto [at, is_new] = middles.try_emplace(std::minmax(a, b));
    if (is_new) at->second = add(0.5 * (division.points[a] + division.points[b]));
    return at->second;
  }
  Vec at(std::uint32_t point) const { return division.points[point]; }
};

using Loop = std::vector<std::uint32_t>;

// The sine of the angle from one way to another.
double eval_sine(const Vec& a, const Vec& b, const Vec& normal) {
  return dot(normal, cross(a, b)) / std::sqrt(dot(a, a) * dot(b, b));
}

std::optional<std::size_t> find_straight_corner(const Quads& quads, const Loop& loop,
                                                const Vec& normal) {
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Vec here = quads.at(loop[i]);
    const Vec ahead = quads.at(loop[(i + 1) % loop.size()]) - here;
    const Vec behind = here - quads.at(loop[(i + loop.size() - 1) % loop.size()]);
    if (dot(ahead, behind) > 0 && eval_sine(behind, ahead, normal) < STRAIGHT) return i;
  }
  return std::nullopt;
}

// The smallest sine of the four angles that a way across a cell makes with its border.
double eval_way(const Quads& quads, const Loop& loop, std::size_t i, std::size_t k,
                const Vec& normal) {
  double least = 1;
  for (const auto& [from, to] : {std::pair{i, k}, std::pair{k, i}}) {
    const Vec here = quads.at(loop[from]), way = quads.at(loop[to]) - here;
    const Vec ahead = quads.at(loop[(from + 1) % loop.size()]) - here;
    const Vec behind = quads.at(loop[(from + loop.size() - 1) % loop.size()]) - here;
    least = std::min({least, eval_sine(ahead, way, normal), eval_sine(way, behind, normal)});
  }
  return least;
}

// Cuts a cell from each straight corner to the corner where that makes the best angles.
void cut_straight_corners(const Quads& quads, Loop loop, const Vec& normal,
                          std::vector<Loop>& parts) {
  const auto straight = find_straight_corner(quads, loop, normal);
  if (!straight || loop.size() == 3) {
    parts.push_back(std::move(loop));
    return;
  }
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(*straight), loop.end());
  std::size_t best = 2;
  double best_sine = -1;
  for (std::size_t k = 2; k + 1 < loop.size(); ++k)
    if (const double sine = eval_way(quads, loop, 0, k, normal); sine > best_sine) {
      best = k;
      best_sine = sine;
    }
  const auto at = loop.begin() + static_cast<std::ptrdiff_t>(best);
  Loop left(at, loop.end());
  left.push_back(loop[0]);
  cut_straight_corners(quads, {loop.begin(), at + 1}, normal, parts);
  cut_straight_corners(quads, std::move(left), normal, parts);
}

// A quad at every corner of a convex polygon: (corner, middle, centre, middle).
void add_corners(Quads& quads, std::span<const std::uint32_t> loop) {
  std::vector<Vec> corners;
  for (const auto point : loop) corners.push_back(quads.at(point));
  const std::uint32_t centre = quads.add(eval_mean(corners));
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto here = loop[i], next = loop[(i + 1) % loop.size()];
    const auto last = loop[(i + loop.size() - 1) % loop.size()];
    const auto ahead = quads.middle(here, next), behind = quads.middle(last, here);
    quads.division.quads.push_back({here, ahead, centre, behind});
  }
}

}  // namespace

Division Cells::make_quads() const {
  Quads quads;
  quads.division.points = points_;
  std::vector<Loop> parts;
  for (const Loop& loop : cells_) cut_straight_corners(quads, loop, normal_, parts);
  for (const Loop& part : parts) add_corners(quads, part);
  return std::move(quads.division);
}

}  // namespace radiosity
