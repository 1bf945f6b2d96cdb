#include "renderer/radiosity/mesh/divide.hpp"

#include <algorithm>
#include <set>

#include "renderer/radiosity/mesh/cells.hpp"

namespace radiosity {

namespace {

// Shares of a patch's width: a point nearer than TOUCH to a crease is on it; a line of the grid
// nearer than KEEP gives way to it; a crease off a side's direction by less than PARALLEL runs
// along that side.
constexpr double TOUCH = 0.1, KEEP = 1.0 / 3, PARALLEL = 1e-3;
// A crease off the face's plane by less than this share of the face's size lies in it.
constexpr double IN_PLANE = 1e-5;
// Points of a grid that are nearer to a crease than this share of a cell move to it.
constexpr double REACH = 0.3;

// Adds a grid over four corners, with lines at these parameters. Its points are its own: where
// grids touch, points are doubled.
void add_grid(Division& division, std::span<const Vec> corners, const std::vector<double>& along,
              const std::vector<double>& across) {
  const auto first = static_cast<std::uint32_t>(division.points.size());
  for (const double t : across)
    for (const double s : along) division.points.push_back(eval_bilinear(corners, s, t));
  const auto row = static_cast<std::uint32_t>(along.size());
  for (std::uint32_t j = 0; j + 1 < across.size(); ++j)
    for (std::uint32_t i = 0; i + 1 < row; ++i) {
      const auto corner = first + j * row + i;
      division.quads.push_back({corner, corner + 1, corner + row + 1, corner + row});
    }
}

// The lines of `count` equal steps from 0 to 1.
std::vector<double> make_even_lines(int count) {
  std::vector<double> lines;
  for (int i = 0; i <= count; ++i) lines.push_back(double(i) / count);
  return lines;
}

// Parameters, 0..1, at which a grid has lines.
struct Row {
  std::vector<double> creases;  // creases along the lines
  std::vector<double> ends;     // ends of creases across the lines
};

// A grid's lines from 0 to 1: those of the row, and of `count` equal steps those that are not near
// one of these. Lines nearer than `touch` to each other are one.
std::vector<double> make_lines(int count, double touch, Row row) {
  std::ranges::sort(row.creases);
  std::ranges::sort(row.ends);
  std::vector<double> lines{0, 1};
  for (const auto* wanted : {&row.creases, &row.ends})
    for (double at : *wanted) {
      // What is off a line of the equal steps by rounding only is that line to the last bit.
      const double step = std::round(at * count) / count;
      if (std::abs(at - step) < 1e-9) at = step;
      const auto is_near = [&](double line) { return std::abs(line - at) < touch; };
      if (at > 0 && at < 1 && std::ranges::none_of(lines, is_near)) lines.push_back(at);
    }
  const std::vector<double> kept(lines.begin() + 2, lines.end());
  for (int i = 1; i < count; ++i) {
    const double at = static_cast<double>(i) / count;
    const auto is_near = [&](double line) { return std::abs(line - at) < KEEP / count; };
    if (std::ranges::none_of(kept, is_near)) lines.push_back(at);
  }
  std::ranges::sort(lines);
  return lines;
}

// A face to be cut, and the creases on it.
struct Cutting {
  const Face& face;
  int along, across;  // patches
  Vec normal;
  double width;                  // of a patch
  std::vector<Crease> near;      // creases in the plane, within or on the border
  std::vector<Crease> crossing;  // those of them that cross the inside
};

Cutting make_cutting(const Face& face, int refine, std::span<const Crease> creases) {
  const auto& corners = face.corners;
  const Vec normal = normalize(eval_area_normal(corners));
  Cutting cutting{face, face.along * refine, face.across * refine, normal, 0, {}, {}};
  double size = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double edge = length(corners[(i + 1) % corners.size()] - corners[i]);
    const double width = corners.size() != 4 ? edge / (2 * cutting.along)
                         : i % 2 == 0        ? edge / cutting.along
                                             : edge / cutting.across;
    cutting.width = i == 0 ? width : std::min(cutting.width, width);
    size = std::max(size, edge);
  }
  const Plane plane = make_plane(normal, eval_mean(corners));
  const std::vector<Plane> edges = make_edge_planes(corners, normal);
  const double touch = TOUCH * cutting.width;
  for (const Crease& crease : creases) {
    if (std::abs(eval_height(plane, crease.a)) > IN_PLANE * size ||
        std::abs(eval_height(plane, crease.b)) > IN_PLANE * size)
      continue;
    const double whole = length(crease.b - crease.a);
    if (!(whole > 0) || !clip_segment(crease.a, crease.b, edges, -touch)) continue;
    cutting.near.push_back(crease);
    const auto inside = clip_segment(crease.a, crease.b, edges, touch);
    if (inside && (inside->to - inside->from) * whole > touch) cutting.crossing.push_back(crease);
  }
  return cutting;
}

// The creases that cross a face: those along the sides of a parallelogram, and all others.
struct Rows {
  Row along, across;
  std::vector<Crease> others;
};

Rows find_rows(const Cutting& cutting) {
  Rows rows{{}, {}, cutting.crossing};
  const auto& c = cutting.face.corners;
  if (c.size() != 4) return rows;
  const Vec u = c[1] - c[0], v = c[3] - c[0];
  if (length(u - (c[2] - c[3])) > PARALLEL * cutting.width) return rows;
  rows.others.clear();
  const double twice = dot(cutting.normal, cross(u, v));
  const auto add = [](Row& own, double p, double q, Row& other, double from, double to) {
    own.creases.push_back((p + q) / 2);
    other.ends.insert(other.ends.end(), {from, to});
  };
  for (const Crease& crease : cutting.crossing) {
    const Vec a = crease.a - c[0], b = crease.b - c[0];
    const auto along = [&](const Vec& p) { return dot(cutting.normal, cross(p, v)) / twice; };
    const auto across = [&](const Vec& p) { return dot(cutting.normal, cross(u, p)) / twice; };
    if (std::abs(along(a) - along(b)) * length(u) <= PARALLEL * cutting.width)
      add(rows.along, along(a), along(b), rows.across, across(a), across(b));
    else if (std::abs(across(a) - across(b)) * length(v) <= PARALLEL * cutting.width)
      add(rows.across, across(a), across(b), rows.along, along(a), along(b));
    else
      rows.others.push_back(crease);
  }
  return rows;
}

Division make_grid(const Cutting& cutting, const Rows& rows, int along, int across) {
  const auto& c = cutting.face.corners;
  const double touch = TOUCH * cutting.width;
  Division division;
  add_grid(division, c, make_lines(along, touch / length(c[1] - c[0]), rows.along),
           make_lines(across, touch / length(c[3] - c[0]), rows.across));
  return division;
}

// The quads' edges on a crease, each once. Short ones may run a little across it.
std::vector<Edge> find_edges(const Division& division, std::span<const Crease> creases,
                             const Vec& normal, double touch) {
  std::vector<Edge> found;
  std::set<Edge> done;
  const auto is_on = [&](const Crease& crease, const Vec& p, const Vec& q) {
    const double size = length(crease.b - crease.a);
    const Vec along = (1 / size) * (crease.b - crease.a), across = cross(normal, along);
    const double s = dot(p - crease.a, along), t = dot(q - crease.a, along);
    return std::abs(dot(p - crease.a, across)) <= touch &&
           std::abs(dot(q - crease.a, across)) <= touch && std::min(s, t) >= -touch &&
           std::max(s, t) <= size + touch && std::abs(s - t) >= 0.5 * length(p - q);
  };
  for (const auto& quad : division.quads)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [a, b] = std::minmax(quad[i], quad[(i + 1) % 4]);
      const Vec &p = division.points[a], &q = division.points[b];
      const auto on = [&](const Crease& crease) { return is_on(crease, p, q); };
      if (std::ranges::any_of(creases, on) && done.insert({a, b}).second) found.push_back({a, b});
    }
  return found;
}

// Cuts along creases in any direction: coarse cells are cut, and each becomes several quads.
Division divide_freely(const Cutting& cutting, const Rows& rows) {
  const int along = (cutting.along + 1) / 2, across = (cutting.across + 1) / 2;
  const bool has_rows = !rows.along.creases.empty() || !rows.across.creases.empty();
  Face coarse = cutting.face;
  coarse.along = along;
  coarse.across = across;
  const Division base = has_rows ? make_grid(cutting, rows, along, across) : divide_face(coarse, 1);
  const double touch = TOUCH * cutting.width;
  std::vector<Edge> fixed;
  if (has_rows) fixed = find_edges(base, cutting.crossing, cutting.normal, touch);
  return cut_cells(base, cutting.normal, fixed, rows.others, {REACH * 2 * cutting.width, touch});
}

}  // namespace

Vec eval_bilinear(std::span<const Vec> c, double s, double t) {
  return (1 - s) * (1 - t) * c[0] + s * (1 - t) * c[1] + s * t * c[2] + (1 - s) * t * c[3];
}

Division divide_face(const Face& face, int refine) {
  Division division;
  const auto& c = face.corners;
  const auto along = make_even_lines(face.along * refine);
  if (c.size() == 4) {
    add_grid(division, c, along, make_even_lines(face.across * refine));
    return division;
  }
  const Vec centre = eval_centre(c);
  const auto middle = [&](std::size_t i) { return 0.5 * (c[i] + c[(i + 1) % c.size()]); };
  for (std::size_t i = 0; i < c.size(); ++i)
    add_grid(division, std::array{c[i], middle(i), centre, middle((i + c.size() - 1) % c.size())},
             along, along);
  return division;
}

Division divide_face(const Face& face, int refine, std::span<const Crease> creases) {
  const Cutting cutting = make_cutting(face, refine, creases);
  const Rows rows = find_rows(cutting);
  Division division;
  if (cutting.crossing.empty())
    division = divide_face(face, refine);
  else if (rows.others.empty())
    division = make_grid(cutting, rows, cutting.along, cutting.across);
  else
    division = divide_freely(cutting, rows);
  division.creases =
      find_edges(division, cutting.near, cutting.normal, 1.01 * TOUCH * cutting.width);
  return division;
}

}  // namespace radiosity
