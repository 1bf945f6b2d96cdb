#include "renderer/radiosity/mesh/cells.hpp"

#include <algorithm>
#include <utility>

#include "renderer/radiosity/mesh/weld.hpp"

namespace radiosity {

namespace {

// Sines of the angles at corners: a cell must keep this when a point moves.
constexpr double WELL_SHAPED = 0.3;

}  // namespace

// Where a line passes into a cell and out of it: at a point, or on the edge from it to `next`.
struct Cells::Chord {
  struct End {
    std::uint32_t point, next;
    double share;  // of the edge; 0 at the point
  };
  std::array<End, 2> ends;
};

Cells::Cells(const Division& division, const Vec& normal) : normal_(normal) {
  double size = 0;
  for (const Vec& point : division.points) size = std::max(size, renderer::max_abs(point));
  Welder welder(size);
  Loop index;
  for (const Vec& point : division.points) {
    index.push_back(welder.weld(point, {}, 0));
    if (index.back() == points_.size()) points_.push_back(point);
  }
  line_.assign(points_.size(), FREE);
  around_.resize(points_.size());
  for (const auto& [a, b, c, d] : division.quads) {
    cells_.push_back({index[a], index[b], index[c], index[d]});
    own(cells_.size() - 1);
    for (const auto point : cells_.back())
      around_[point].push_back(static_cast<std::uint32_t>(cells_.size() - 1));
  }
  for (const auto& [edge, cell] : owner_)
    if (!owner_.contains({edge.second, edge.first})) {
      fix(edge.first);
      fix(edge.second);
    }
}

void Cells::own(std::size_t cell) {
  const Loop& loop = cells_[cell];
  for (std::size_t i = 0; i < loop.size(); ++i)
    owner_[{loop[i], loop[(i + 1) % loop.size()]}] = cell;
}

bool Cells::move(std::uint32_t point, const Vec& to) {
  const Vec back = std::exchange(points_[point], to);
  for (const auto cell : around_[point]) {
    const Loop& loop = cells_[cell];
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec here = points_[loop[i]];
      const Vec ahead = points_[loop[(i + 1) % 4]] - here,
                behind = points_[loop[(i + 3) % 4]] - here;
      if (dot(normal_, cross(ahead, behind)) < WELL_SHAPED * length(ahead) * length(behind)) {
        points_[point] = back;
        return false;
      }
    }
  }
  return true;
}

void Cells::move_to_end(const Vec& end, double reach) {
  std::optional<std::uint32_t> nearest;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    const double distance = length(points_[i] - end);
    if (distance >= reach || line_[i] == FIXED) continue;
    reach = distance;
    nearest = i;
  }
  if (nearest && move(*nearest, end)) fix(*nearest);
}

void Cells::move_points(std::span<const Crease> creases, double reach) {
  for (const Crease& crease : creases)
    for (const Vec& end : {crease.a, crease.b}) move_to_end(end, reach);
  for (std::size_t k = 0; k < creases.size(); ++k) {
    const Vec a = creases[k].a, along = normalize(creases[k].b - a);
    const Vec across = cross(normal_, along);
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      if (line_[i] == FIXED) continue;
      const Vec here = points_[i];
      const double height = dot(across, here - a);
      if (std::abs(height) >= reach) continue;
      Vec to = here - height * across;
      if (line_[i] != FREE) {  // along the crease that it is on
        const Crease& other = creases[static_cast<std::size_t>(line_[i])];
        const Vec way = normalize(other.b - other.a);
        const double slope = dot(across, way);
        if (std::abs(height) >= reach * std::abs(slope)) continue;
        to = here - (height / slope) * way;
      }
      const double t = dot(to - a, along);
      if (t < 0 || t > length(creases[k].b - a) || !move(i, to)) continue;
      line_[i] = line_[i] == FREE ? static_cast<std::int32_t>(k) : FIXED;
    }
  }
}

std::optional<Cells::Chord> Cells::find_chord(std::size_t cell,
                                              std::span<const double> heights) const {
  const Loop& loop = cells_[cell];
  const std::size_t count = loop.size();
  std::size_t start = 0;
  while (start < count && heights[loop[start]] == 0) ++start;
  if (start == count) return std::nullopt;
  Chord chord;
  std::size_t found = 0;
  std::uint32_t last = loop[start];  // that is not on the line
  for (std::size_t i = 1; i <= count; ++i) {
    const std::uint32_t before = loop[(start + i - 1) % count], here = loop[(start + i) % count];
    if (heights[here] == 0) continue;
    if ((heights[here] > 0) != (heights[last] > 0)) {
      if (found == 2) return std::nullopt;
      // The last point on the line, if there is one between.
      const double share = before == last ? heights[last] / (heights[last] - heights[here]) : 0;
      chord.ends[found++] = {before, here, share};
    }
    last = here;
  }
  if (found < 2) return std::nullopt;
  return chord;
}

std::uint32_t Cells::split_edge(std::uint32_t a, std::uint32_t b, double share) {
  const auto point = static_cast<std::uint32_t>(points_.size());
  points_.push_back(lerp(points_[a], points_[b], share));
  for (const auto& [from, to] : {std::pair{a, b}, std::pair{b, a}}) {
    const auto owner = owner_.find({from, to});
    if (owner == owner_.end()) continue;
    const std::size_t cell = owner->second;
    owner_.erase(owner);
    Loop& loop = cells_[cell];
    const auto at = std::find(loop.begin(), loop.end(), from);
    loop.insert(at + 1, point);
    owner_[{from, point}] = owner_[{point, to}] = cell;
  }
  return point;
}

void Cells::cut(const Crease& crease, double touch) {
  const double size = length(crease.b - crease.a);
  const Vec along = (1 / size) * (crease.b - crease.a), across = cross(normal_, along);
  std::vector<double> heights;
  const auto measure = [&](const Vec& point) {
    const double height = dot(across, point - crease.a);
    heights.push_back(std::abs(height) <= touch ? 0 : height);
  };
  for (const Vec& point : points_) measure(point);

  const std::size_t count = cells_.size();
  for (std::size_t cell = 0; cell < count; ++cell) {
    const auto chord = find_chord(cell, heights);
    if (!chord) continue;
    // Where on the crease, from 0 to its size, the chord begins and ends.
    double t[2];
    for (std::size_t i = 0; i < 2; ++i) {
      const auto& [point, next, share] = chord->ends[i];
      t[i] = dot(lerp(points_[point], points_[next], share) - crease.a, along);
    }
    if (std::min(size, std::max(t[0], t[1])) - std::max(0.0, std::min(t[0], t[1])) <= touch)
      continue;
    const auto make = [&](const Chord::End& end) {
      if (end.share == 0) return end.point;
      heights.push_back(0);
      return split_edge(end.point, end.next, end.share);
    };
    const std::uint32_t p = make(chord->ends[0]), q = make(chord->ends[1]);
    Loop loop = cells_[cell];
    std::rotate(loop.begin(), std::find(loop.begin(), loop.end(), p), loop.end());
    const auto at = std::find(loop.begin(), loop.end(), q);
    const Loop right(loop.begin(), at + 1);
    Loop left(at, loop.end());
    left.push_back(p);
    cells_[cell] = right;
    cells_.push_back(left);
    own(cell);
    own(cells_.size() - 1);
  }

  // The crease's ends become points of the edges that it lies on.
  for (const double end : {0.0, size}) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& [edge, cell] : owner_) {
      const auto& [a, b] = edge;
      if (heights[a] != 0 || heights[b] != 0 || (a > b && owner_.contains({b, a}))) continue;
      const double from = dot(points_[a] - crease.a, along), to = dot(points_[b] - crease.a, along);
      if (std::min(from, to) + touch < end && end < std::max(from, to) - touch)
        edges.push_back(edge);
    }
    for (const auto& [a, b] : edges) {
      const double from = dot(points_[a] - crease.a, along), to = dot(points_[b] - crease.a, along);
      split_edge(a, b, (end - from) / (to - from));
      heights.push_back(0);
    }
  }
}

}  // namespace radiosity
