#include "renderer/radiosity/mesh/cells.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "renderer/radiosity/mesh/weld.hpp"

namespace radiosity {

namespace {

// Smallest sine of the angles at a cell's corners after a point has moved.
constexpr double WELL_SHAPED = 0.3;
// A corner counts as straight if the sine of its exterior angle is smaller than this.
constexpr double STRAIGHT = 0.17;
// Limits in units of Line::touch. After a cut, each part must be at least half as wide as the cell
// was, but this limit is itself clamped to the range from FLATTEST to FLAT. Distances from a crease
// below ROUNDING count as 0.
constexpr double FLAT = 0.25, FLATTEST = 0.02, ROUNDING = 1e-6;
// When a cell is cut at a straight corner, all angles of the cut must have a larger sine than this.
constexpr double TOO_NARROW = 1e-3;

using Loop = std::vector<std::uint32_t>;

// The two parts of a loop of points that is cut from one of its points to another. Both parts
// contain both points.
std::pair<Loop, Loop> cut_loop(Loop loop, std::uint32_t from, std::uint32_t to) {
  std::ranges::rotate(loop, std::ranges::find(loop, from));
  const auto at = std::ranges::find(loop, to);
  Loop left(at, loop.end());
  left.push_back(from);
  loop.erase(at + 1, loop.end());
  return {std::move(loop), std::move(left)};
}

// A straight line across a cell. Each end is at a point, or on the edge from this point to `next`.
struct Chord {
  struct End {
    std::uint32_t point, next;
    double share;  // position on the edge as a fraction; 0 at `point`
  };
  std::array<End, 2> ends;
};

// The points and quads made so far. `middles` has the middle point of each edge.
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

// The sine of the angle from direction a to direction b, about the normal.
double eval_sine(const Vec& a, const Vec& b, const Vec& normal) {
  return dot(normal, cross(a, b)) / std::sqrt(dot(a, a) * dot(b, b));
}

bool is_straight(const Quads& quads, const Loop& loop, std::size_t i, const Vec& normal) {
  const Vec here = quads.at(loop[i]);
  const Vec ahead = quads.at(loop[(i + 1) % loop.size()]) - here;
  const Vec behind = here - quads.at(loop[(i + loop.size() - 1) % loop.size()]);
  return dot(ahead, behind) > 0 && eval_sine(behind, ahead, normal) < STRAIGHT;
}

// The smallest sine of the four angles between the border of a cell and the line from its corner i
// to its corner k.
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

// Cuts a cell at each straight corner, recursively. Each cut leads to the corner that gives the
// best angles. Adds the resulting cells to `parts`.
void cut_straight_corners(const Quads& quads, const Loop& loop, const Vec& normal,
                          std::vector<Loop>& parts) {
  std::uint32_t from = 0, to = 0;
  double best = TOO_NARROW;
  for (std::size_t i = 0; i < loop.size() && loop.size() > 3; ++i) {
    if (!is_straight(quads, loop, i, normal)) continue;
    for (std::size_t k = i + 2; k + 1 < i + loop.size(); ++k)
      if (const double sine = eval_way(quads, loop, i, k % loop.size(), normal); sine > best) {
        from = loop[i];
        to = loop[k % loop.size()];
        best = sine;
      }
  }
  if (best == TOO_NARROW) {
    parts.push_back(loop);
    return;
  }
  const auto [right, left] = cut_loop(loop, from, to);
  cut_straight_corners(quads, right, normal, parts);
  cut_straight_corners(quads, left, normal, parts);
}

// The centroid of a convex polygon. As seen from any corner, it lies beyond the line between the
// middles of the adjacent edges, as the quads of add_corners() require. The mean of the corners may
// lie in front of such a line.
Vec find_centre(std::span<const Vec> corners, const Vec& normal) {
  Vec sum;
  double total = 0;
  for (std::size_t i = 2; i < corners.size(); ++i) {
    const Vec a = corners[i - 1] - corners[0], b = corners[i] - corners[0];
    const double area = dot(normal, cross(a, b));
    sum += area / 3 * (a + b);
    total += area;
  }
  return corners[0] + (1 / total) * sum;
}

// Adds a quad for each corner of a convex polygon, with four points: the corner, the middle of the
// next edge, the centre, and the middle of the previous edge.
void add_corners(Quads& quads, std::span<const std::uint32_t> loop, const Vec& normal) {
  std::vector<Vec> corners;
  for (const auto point : loop) corners.push_back(quads.at(point));
  const std::uint32_t centre = quads.add(find_centre(corners, normal));
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const auto here = loop[i], next = loop[(i + 1) % loop.size()];
    const auto last = loop[(i + loop.size() - 1) % loop.size()];
    const auto ahead = quads.middle(here, next), behind = quads.middle(last, here);
    quads.division.quads.push_back({here, ahead, centre, behind});
  }
}

// Cells of a face, each a convex polygon. If only one of two neighbouring cells is cut at a point
// of their common edge, this point becomes a straight corner of the other cell.
class Cells {
 public:
  // Starts with the quads of a division as cells. Merges equal points, but keeps the order of
  // points.
  Cells(const Division& division, const Vec& normal) : normal_(normal) {
    Welder welder(renderer::make_bounds(division.points));
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

  // Prevents a point from being moved.
  void fix(std::uint32_t point) { line_[point] = FIXED; }

  // Moves points that are nearer than `reach` to the lines number `first` to `last` - 1 onto these
  // lines. Omits moves that would bring points nearer than `apart` to each other.
  void move_points(std::span<const Line> lines, std::size_t first, std::size_t last, double reach,
                   double apart) {
    for (std::size_t k = first; k < last; ++k)
      for (const Vec& end : {lines[k].crease.a, lines[k].crease.b}) move_to_end(end, reach, apart);
    for (std::size_t k = first; k < last; ++k) {
      const Crease& crease = lines[k].crease;
      const Vec along = normalize(crease.b - crease.a), across = cross(normal_, along);
      for (std::uint32_t i = 0; i < points_.size(); ++i) {
        if (line_[i] == FIXED) continue;
        const Vec here = points_[i];
        const double height = dot(across, here - crease.a);
        if (std::abs(height) >= reach) continue;
        Vec to = here - height * across;
        if (line_[i] != FREE) {  // the point lies on another crease: move along that crease
          const Crease& other = lines[static_cast<std::size_t>(line_[i])].crease;
          const Vec way = normalize(other.b - other.a);
          const double slope = dot(across, way);
          if (std::abs(height) >= reach * std::abs(slope)) continue;
          to = here - (height / slope) * way;
        }
        const double t = dot(to - crease.a, along);
        if (t < 0 || t > length(crease.b - crease.a) || !move(i, to, apart)) continue;
        line_[i] = line_[i] == FREE ? static_cast<std::int32_t>(k) : FIXED;
      }
    }
  }

  // Cuts all cells that the crease crosses over a length of more than `touch`. Returns false if
  // some of them could not be cut.
  bool cut(const Line& line) {
    const Crease& crease = line.crease;
    const double size = length(crease.b - crease.a), touch = line.touch;
    const Vec along = (1 / size) * (crease.b - crease.a), across = cross(normal_, along);
    std::vector<double> heights;
    for (const Vec& point : points_) {
      const double height = dot(across, point - crease.a);
      heights.push_back(std::abs(height) <= ROUNDING * touch ? 0 : height);
    }
    const std::size_t count = cells_.size();
    bool kept = true;
    for (std::size_t cell = 0; cell < count; ++cell) {
      const auto chord = find_chord(cell, heights);
      if (!chord) continue;
      // Positions of the chord's ends along the crease, from 0 to the crease's length.
      double t[2];
      for (std::size_t i = 0; i < 2; ++i) {
        const auto& [point, next, share] = chord->ends[i];
        t[i] = dot(lerp(points_[point], points_[next], share) - crease.a, along);
      }
      if (std::min(size, std::max(t[0], t[1])) - std::max(0.0, std::min(t[0], t[1])) <= touch)
        continue;
      // The new point depends only on the edge, so that both cells at the edge get the same point.
      const auto make = [&](const Chord::End& end) {
        if (end.share == 0) return end.point;
        const double here = std::abs(heights[end.point]), there = std::abs(heights[end.next]);
        if (std::min(here, there) <= touch) return here <= there ? end.point : end.next;
        heights.push_back(0);
        return split_edge(end.point, end.next, end.share);
      };
      const std::uint32_t p = make(chord->ends[0]), q = make(chord->ends[1]);
      if (!cut_cell(cell, p, q, touch)) kept = false;
    }
    // Splits the edges on which the two ends of the crease lie.
    for (const double end : {0.0, size}) split_edges_at(crease.a, along, end, touch, heights);
    return kept;
  }

  std::size_t size() const { return cells_.size(); }

  Division make_quads() const {
    Quads quads;
    quads.division.points = points_;
    std::vector<Loop> parts;
    for (const Loop& loop : cells_) cut_straight_corners(quads, loop, normal_, parts);
    for (const Loop& part : parts) add_corners(quads, part, normal_);
    return std::move(quads.division);
  }

 private:
  static constexpr std::int32_t FREE = -1, FIXED = -2;

  void own(std::size_t cell) {
    const Loop& loop = cells_[cell];
    for (std::size_t i = 0; i < loop.size(); ++i)
      owner_[{loop[i], loop[(i + 1) % loop.size()]}] = cell;
  }

  // Moves a point. Returns false, and does not move it, if a cell would become ill-shaped, or if an
  // edge shorter than `apart` would become even shorter.
  bool move(std::uint32_t point, const Vec& to, double apart) {
    const Vec back = std::exchange(points_[point], to);
    for (const auto cell : around_[point]) {
      const Loop& loop = cells_[cell];
      for (std::size_t i = 0; i < 4; ++i) {
        const Vec here = points_[loop[i]];
        const Vec ahead = points_[loop[(i + 1) % 4]] - here;
        const Vec behind = points_[loop[(i + 3) % 4]] - here;
        const double least = WELL_SHAPED * length(ahead) * length(behind);
        const double now = std::min(length(ahead), length(behind));
        const bool is_short =
            loop[i] == point && now < apart &&
            now < std::min(length(here + ahead - back), length(here + behind - back));
        if (is_short || dot(normal_, cross(ahead, behind)) < least) {
          points_[point] = back;
          return false;
        }
      }
    }
    return true;
  }

  void move_to_end(const Vec& end, double reach, double apart) {
    std::optional<std::uint32_t> nearest;
    for (std::uint32_t i = 0; i < points_.size(); ++i) {
      const double distance = length(points_[i] - end);
      if (distance >= reach || line_[i] == FIXED) continue;
      reach = distance;
      nearest = i;
    }
    if (nearest && move(*nearest, end, apart)) fix(*nearest);
  }

  // The smallest width of a cell, measured perpendicular to each of its edges.
  double find_width(const Loop& loop) const {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < loop.size(); ++i)
      least = std::min(least, find_height(loop, loop[i], loop[(i + 1) % loop.size()]));
    return least;
  }
  // The largest distance of a loop's points from the line through the points a and b.
  double find_height(const Loop& loop, std::uint32_t a, std::uint32_t b) const {
    const Vec across = cross(normal_, normalize(points_[b] - points_[a]));
    double most = 0;
    for (const auto point : loop)
      most = std::max(most, std::abs(dot(across, points_[point] - points_[a])));
    return most;
  }

  // Cuts a cell from its point p to its point q. Returns false if a part would be too narrow.
  // Returns true without a cut if the crease runs along the edges of the cell.
  bool cut_cell(std::size_t cell, std::uint32_t p, std::uint32_t q, double touch) {
    if (p == q) return true;
    const auto [right, left] = cut_loop(cells_[cell], p, q);
    if (std::min(find_height(right, p, q), find_height(left, p, q)) < FLAT * touch) return true;
    const double least = std::clamp(0.5 * find_width(cells_[cell]), FLATTEST * touch, FLAT * touch);
    if (std::min(find_width(right), find_width(left)) < least) return false;
    cells_[cell] = right;
    cells_.push_back(left);
    own(cell);
    own(cells_.size() - 1);
    return true;
  }

  std::optional<Chord> find_chord(std::size_t cell, std::span<const double> heights) const {
    const Loop& loop = cells_[cell];
    const std::size_t count = loop.size();
    std::size_t start = 0;
    while (start < count && heights[loop[start]] == 0) ++start;
    if (start == count) return std::nullopt;
    Chord chord;
    std::size_t found = 0;
    std::uint32_t last = loop[start];  // the latest point that is not on the line
    for (std::size_t i = 1; i <= count; ++i) {
      const std::uint32_t before = loop[(start + i - 1) % count], here = loop[(start + i) % count];
      if (heights[here] == 0) continue;
      if ((heights[here] > 0) != (heights[last] > 0)) {
        if (found == 2) return std::nullopt;
        // If points of the loop lie on the line, the last of them is the chord's end. Otherwise,
        // the end is interpolated on the edge.
        const double share = before == last ? heights[last] / (heights[last] - heights[here]) : 0;
        chord.ends[found++] = {before, here, share};
      }
      last = here;
    }
    if (found < 2) return std::nullopt;
    return chord;
  }

  std::uint32_t split_edge(std::uint32_t a, std::uint32_t b, double share) {
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

  // Inserts a point into every edge that lies on the line through `origin` in direction `along`.
  // The point is at the distance `end` from `origin`. An edge lies on the line if both of its ends
  // are within `touch` of it.
  void split_edges_at(const Vec& origin, const Vec& along, double end, double touch,
                      std::vector<double>& heights) {
    const auto place = [&](std::uint32_t point) { return dot(points_[point] - origin, along); };
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (const auto& [edge, cell] : owner_) {
      const auto& [a, b] = edge;
      if (std::max(std::abs(heights[a]), std::abs(heights[b])) > touch) continue;
      if (a > b && owner_.contains({b, a})) continue;
      if (std::min(place(a), place(b)) + touch < end && end < std::max(place(a), place(b)) - touch)
        edges.push_back(edge);
    }
    for (const auto& [a, b] : edges) {
      split_edge(a, b, (end - place(a)) / (place(b) - place(a)));
      heights.push_back(0);
    }
  }

  Vec normal_;
  std::vector<Vec> points_;
  // By point: index of the crease to which it was moved, FREE or FIXED.
  std::vector<std::int32_t> line_;
  std::vector<Loop> cells_;
  std::vector<Loop> around_;  // by point: the cells around it, before the first cut
  // The cell on the left of each edge, by the edge's start and end.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> owner_;
};

}  // namespace

Division cut_cells(const Division& division, const Vec& normal, std::span<const Edge> fixed,
                   std::span<const Line> lines, const CellParams& params) {
  Cells cells(division, normal);
  for (const Edge& edge : fixed)
    for (const auto point : edge) cells.fix(point);
  const auto contacts =
      static_cast<std::size_t>(std::ranges::find(lines, false, &Line::contact) - lines.begin());
  cells.move_points(lines, 0, contacts, params.reach, params.apart);
  cells.move_points(lines, contacts, lines.size(), params.reach, params.apart);
  std::size_t left_out = 0;
  for (const Line& line : lines)
    if (line.contact)
      cells.cut(line);
    else if (cells.size() >= params.most || !cells.cut(line))
      ++left_out;
  Division cut = cells.make_quads();
  cut.left_out = left_out;
  return cut;
}

}  // namespace radiosity
