// How cells become quads.
#include "renderer/radiosity/mesh/cells.hpp"

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

bool is_straight(const Quads& quads, const Loop& loop, std::size_t i, const Vec& normal) {
  const Vec here = quads.at(loop[i]);
  const Vec ahead = quads.at(loop[(i + 1) % loop.size()]) - here;
  const Vec behind = here - quads.at(loop[(i + loop.size() - 1) % loop.size()]);
  return dot(ahead, behind) > 0 && eval_sine(behind, ahead, normal) < STRAIGHT;
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

// Cuts a cell with straight corners from one of these to another corner, where that makes the best
// angles, and its parts again.
void cut_straight_corners(const Quads& quads, Loop loop, const Vec& normal,
                          std::vector<Loop>& parts) {
  std::size_t from = 0, to = 0;
  double best = 0;
  for (std::size_t i = 0; i < loop.size() && loop.size() > 3; ++i) {
    if (!is_straight(quads, loop, i, normal)) continue;
    for (std::size_t k = i + 2; k + 1 < i + loop.size(); ++k)
      if (const double sine = eval_way(quads, loop, i, k % loop.size(), normal); sine > best) {
        from = i;
        to = k - i;
        best = sine;
      }
  }
  if (best == 0) {
    parts.push_back(std::move(loop));
    return;
  }
  std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(from), loop.end());
  const auto at = loop.begin() + static_cast<std::ptrdiff_t>(to);
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
