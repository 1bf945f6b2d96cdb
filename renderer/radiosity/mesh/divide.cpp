#include "renderer/radiosity/mesh/divide.hpp"

#include <algorithm>
#include <set>

#include "renderer/radiosity/mesh/cells.hpp"

namespace radiosity {

namespace {

// A crease replaces a line of the face's grid if it is nearer than the fraction KEEP of the step
// between lines. A crease counts as parallel to a side if it deviates by at most the fraction ALONG
// of a patch's width.
constexpr double KEEP = 1.0 / 3, ALONG = 1e-3;
// Tolerances in units of Line::touch. An edge of a quad lies on a crease if it is at most ASIDE
// beside the crease and at most BEYOND beyond its ends.
constexpr double ASIDE = 1.1, BEYOND = 1.01;
// A face with fewer patches than this counts as having this many when the number of its creases is
// limited.
constexpr std::size_t LEAST_PATCHES = 16;
// A crease lies in the plane of a face if its distance is less than this fraction of the face's
// size.
constexpr double IN_PLANE = 1e-5;
// To cut a face along creases of any direction, its grid is first made coarse: a cell is two
// patches wide. A grid point moves to a crease that is nearer than this fraction of a cell.
constexpr double REACH = 0.3;

// Adds a grid between four corners, with lines at the parameters `along` and `across`, from 0 to 1.
// Grids do not share points, so that points are doubled where grids touch.
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

// The positions of lines at `count` equal steps from 0 to 1.
std::vector<double> make_even_lines(int count) {
  std::vector<double> lines;
  for (int i = 0; i <= count; ++i) lines.push_back(double(i) / count);
  return lines;
}

// The wanted position of a grid line, from 0 to 1. It is omitted if an earlier line is nearer than
// `touch`.
struct Wanted {
  double at = 0, touch = 0;
};

// The wanted lines of a grid in one direction, in order of priority: contacts, then creases
// parallel to the lines, then the ends of creases at right angles to them.
struct Row {
  std::vector<Wanted> contacts, creases, ends;
};

bool is_near(std::span<const double> lines, const Wanted& wanted) {
  return std::ranges::any_of(
      lines, [&](double line) { return std::abs(line - wanted.at) < wanted.touch; });
}

// The grid lines from 0 to 1: the wanted lines, and those given lines that are not near a wanted
// line.
std::vector<double> make_lines(const std::vector<double>& given, Row row) {
  std::ranges::sort(row.creases, {}, &Wanted::at);
  std::ranges::sort(row.ends, {}, &Wanted::at);
  std::vector<double> lines{0, 1};
  for (const auto* some : {&row.contacts, &row.creases, &row.ends})
    for (Wanted wanted : *some) {
      // A position that equals a given line up to rounding becomes that line bit for bit.
      for (const double line : given)
        if (std::abs(wanted.at - line) < 1e-9) wanted.at = line;
      if (wanted.at > 0 && wanted.at < 1 && !is_near(lines, wanted)) lines.push_back(wanted.at);
    }
  const std::vector<double> kept(lines.begin() + 2, lines.end());
  for (std::size_t i = 1; i + 1 < given.size(); ++i) {
    const double gap = std::min(given[i] - given[i - 1], given[i + 1] - given[i]);
    if (!is_near(kept, {given[i], KEEP * gap})) lines.push_back(given[i]);
  }
  std::ranges::sort(lines);
  return lines;
}

// A face to be divided, and the creases and contacts on it.
struct Cutting {
  const Face& face;
  int along, across;  // number of patches along and across the face
  std::size_t most;   // creases are omitted beyond this number of patches
  Vec normal;
  double width;                // width of a patch
  std::vector<Line> contacts;  // in the face's plane, inside the face or on its border
  // Folds and creases in the face's plane, inside the face or on its border.
  std::vector<Line> creases;
  std::vector<Line> crossing;  // contacts, folds, strips and creases inside the face
};

// The length of that part of a crease that is at least `margin` above all planes.
double find_inside(const Crease& crease, std::span<const Plane> planes, double margin) {
  const auto inside = clip_segment(crease.a, crease.b, planes, margin);
  return inside ? (inside->to - inside->from) * length(crease.b - crease.a) : 0;
}

double find_least_step(const std::vector<double>& lines) {
  double least = 1;
  for (std::size_t i = 0; i + 1 < lines.size(); ++i)
    least = std::min(least, lines[i + 1] - lines[i]);
  return least;
}

Cutting make_cutting(const Face& face, int refine, const Cuts& cuts) {
  const auto& corners = face.corners;
  const Vec normal = normalize(eval_area_normal(corners));
  const Grid grid = find_grid(face, refine);
  const auto along = static_cast<int>(grid.along.size()) - 1;
  const auto across = static_cast<int>(grid.across.size()) - 1;
  Cutting cutting{face, along, across, 0, normal, find_patch_width(face, refine), {}, {}, {}};
  cutting.most =
      std::max(count_quads(face, refine), LEAST_PATCHES) * static_cast<std::size_t>(cuts.growth);
  const std::vector<Plane> edges = make_edge_planes(corners, normal);
  const auto add = [&](std::span<const Crease> creases, double share, bool contact,
                       std::vector<Line>* near) {
    const double touch = share * cutting.width;
    for (const Crease& crease : select_creases(face, creases, touch)) {
      const Line line{crease, touch, contact};
      if (near) near->push_back(line);
      if (find_inside(crease, edges, touch) > touch) cutting.crossing.push_back(line);
    }
  };
  add(cuts.contacts, CONTACT_TOUCH, true, &cutting.contacts);
  add(cuts.folds, CONTACT_TOUCH, true, &cutting.creases);
  add(cuts.strips, CONTACT_TOUCH, true, nullptr);
  add(cuts.creases, CREASE_TOUCH, false, &cutting.creases);
  return cutting;
}

// The creases of a parallelogram that are parallel to its sides, and all other creases.
struct Rows {
  Row along, across;
  std::vector<Line> others;
  std::size_t left_out = 0;
};

std::size_t count_lines(const Row& row, int even) {
  return row.contacts.size() + row.creases.size() + row.ends.size() +
         static_cast<std::size_t>(even);
}

// Adds a line to the row of grid lines parallel to it, and its two ends to the other row.
void add_to_rows(const Line& line, double at, double from, double to, Row& own, double own_size,
                 Row& other, double other_size) {
  (line.contact ? own.contacts : own.creases).push_back({at, line.touch / own_size});
  for (const double end : {from, to})
    (line.contact ? other.contacts : other.ends).push_back({end, line.touch / other_size});
}

Rows find_rows(const Cutting& cutting) {
  Rows rows{{}, {}, cutting.crossing};
  const auto& c = cutting.face.corners;
  if (c.size() != 4) return rows;
  const Vec u = c[1] - c[0], v = c[3] - c[0];
  if (length(u - (c[2] - c[3])) > ALONG * cutting.width) return rows;
  rows.others.clear();
  const double twice = dot(cutting.normal, cross(u, v)), wide = length(u), high = length(v);
  for (const Line& line : cutting.crossing) {
    const Vec a = line.crease.a - c[0], b = line.crease.b - c[0];
    const auto along = [&](const Vec& p) { return dot(cutting.normal, cross(p, v)) / twice; };
    const auto across = [&](const Vec& p) { return dot(cutting.normal, cross(u, p)) / twice; };
    const bool is_up = std::abs(along(a) - along(b)) * wide <= ALONG * cutting.width;
    const bool is_level = std::abs(across(a) - across(b)) * high <= ALONG * cutting.width;
    if (!is_up && !is_level)
      rows.others.push_back(line);
    else if (!line.contact &&
             count_lines(rows.along, cutting.along) * count_lines(rows.across, cutting.across) >=
                 cutting.most)
      ++rows.left_out;
    else if (is_up)
      add_to_rows(line, (along(a) + along(b)) / 2, across(a), across(b), rows.along, wide,
                  rows.across, high);
    else
      add_to_rows(line, (across(a) + across(b)) / 2, along(a), along(b), rows.across, high,
                  rows.along, wide);
  }
  return rows;
}

Division make_grid(const Cutting& cutting, const Rows& rows, const Grid& even) {
  Division division;
  add_grid(division, cutting.face.corners, make_lines(even.along, rows.along),
           make_lines(even.across, rows.across));
  return division;
}

// Removes every second line where neighbouring steps are equal.
std::vector<double> thin_out(const std::vector<double>& lines) {
  std::vector<double> some{lines.front()};
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const bool was_kept = some.back() == lines[i - 1];
    const auto step = [&](std::size_t k) { return lines[k] - lines[k - 1]; };
    if (i + 1 < lines.size() && was_kept && std::abs(step(i) - step(i + 1)) < 1e-6 * step(i))
      continue;
    some.push_back(lines[i]);
  }
  return some;
}

// The edges of quads that lie on one of the lines; each edge occurs once. Short edges may be at a
// small angle to the line.
std::vector<Edge> find_edges(const Division& division, std::span<const Line> lines,
                             const Vec& normal) {
  std::vector<Edge> found;
  std::set<Edge> done;
  const auto is_on = [&](const Line& line, const Vec& p, const Vec& q) {
    const Crease& crease = line.crease;
    const double size = length(crease.b - crease.a);
    const double aside = ASIDE * line.touch, beyond = BEYOND * line.touch;
    const Vec along = (1 / size) * (crease.b - crease.a), across = cross(normal, along);
    const double s = dot(p - crease.a, along), t = dot(q - crease.a, along);
    return std::abs(dot(p - crease.a, across)) <= aside &&
           std::abs(dot(q - crease.a, across)) <= aside && std::min(s, t) >= -beyond &&
           std::max(s, t) <= size + beyond && std::abs(s - t) >= 0.5 * length(p - q);
  };
  for (const auto& quad : division.quads)
    for (std::size_t i = 0; i < 4; ++i) {
      const auto [a, b] = std::minmax(quad[i], quad[(i + 1) % 4]);
      const Vec &p = division.points[a], &q = division.points[b];
      const auto on = [&](const Line& line) { return is_on(line, p, q); };
      if (std::ranges::any_of(lines, on) && done.insert({a, b}).second) found.push_back({a, b});
    }
  return found;
}

// Divides a face with creases of any direction. First cuts coarse cells along the creases, then
// divides each cell into several quads.
Division divide_freely(const Cutting& cutting, const Rows& rows) {
  Face coarse = cutting.face;
  coarse.along = (cutting.along + 1) / 2;
  coarse.across = (cutting.across + 1) / 2;
  if (!coarse.grid.along.empty())
    coarse.grid = {thin_out(coarse.grid.along), thin_out(coarse.grid.across)};
  const bool has_rows = count_lines(rows.along, 0) + count_lines(rows.across, 0) > 0;
  const Division base =
      has_rows ? make_grid(cutting, rows, find_grid(coarse, 1)) : divide_face(coarse, 1);
  std::vector<Edge> fixed;
  if (has_rows) fixed = find_edges(base, cutting.crossing, cutting.normal);
  const double reach = REACH * 2 * cutting.width, apart = 2 * CREASE_TOUCH * cutting.width;
  return cut_cells(base, cutting.normal, fixed, rows.others, {reach, apart, cutting.most / 4});
}

}  // namespace

Vec eval_bilinear(std::span<const Vec> c, double s, double t) {
  return (1 - s) * (1 - t) * c[0] + s * (1 - t) * c[1] + s * t * c[2] + (1 - s) * t * c[3];
}

Grid find_grid(const Face& face, int refine) {
  if (!face.grid.along.empty()) return face.grid;
  return {make_even_lines(face.along * refine), make_even_lines(face.across * refine)};
}

void halve(std::vector<double>& lines, const std::vector<bool>& marks) {
  std::vector<double> finer;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    finer.push_back(lines[i]);
    if (i + 1 < lines.size() && marks[i]) finer.push_back((lines[i] + lines[i + 1]) / 2);
  }
  lines = std::move(finer);
}

std::vector<Crease> select_creases(const Face& face, std::span<const Crease> creases,
                                   double touch) {
  const auto& corners = face.corners;
  double size = 0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    size = std::max(size, length(corners[(i + 1) % corners.size()] - corners[i]));
  const Vec normal = normalize(eval_area_normal(corners));
  const Plane plane = make_plane(normal, eval_mean(corners));
  const std::vector<Plane> edges = make_edge_planes(corners, normal);
  std::vector<Crease> selected;
  for (const Crease& crease : creases)
    if (std::abs(eval_height(plane, crease.a)) <= IN_PLANE * size &&
        std::abs(eval_height(plane, crease.b)) <= IN_PLANE * size &&
        find_inside(crease, edges, -touch) > 0)
      selected.push_back(crease);
  return selected;
}

double find_patch_width(const Face& face, int refine) {
  const auto& corners = face.corners;
  const Grid grid = find_grid(face, refine);
  const auto along = static_cast<double>(grid.along.size() - 1);
  double least = INFINITY;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double edge = length(corners[(i + 1) % corners.size()] - corners[i]);
    const double step = corners.size() != 4 ? 1 / (2 * along)
                        : i % 2 == 0        ? find_least_step(grid.along)
                                            : find_least_step(grid.across);
    least = std::min(least, edge * step);
  }
  return least;
}

std::size_t count_quads(const Face& face, int refine) {
  if (!face.grid.along.empty()) return (face.grid.along.size() - 1) * (face.grid.across.size() - 1);
  const auto along = static_cast<std::size_t>(face.along) * static_cast<std::size_t>(refine);
  const auto across = static_cast<std::size_t>(face.across) * static_cast<std::size_t>(refine);
  return face.corners.size() == 4 ? along * across : face.corners.size() * along * along;
}

std::size_t count_patches(const Room& room, int refine) {
  std::size_t count = 0;
  for (const Face& face : room.faces)
    if (!room.materials[face.material].mirror)
      count += (face.two_sided ? 2 : 1) * count_quads(face, refine);
  return count;
}

Division divide_face(const Face& face, int refine) {
  Division division;
  const auto& c = face.corners;
  if (c.size() == 4) {
    const Grid grid = find_grid(face, refine);
    add_grid(division, c, grid.along, grid.across);
    return division;
  }
  const auto along = make_even_lines(face.along * refine);
  const Vec centre = eval_centre(c);
  const auto middle = [&](std::size_t i) { return 0.5 * (c[i] + c[(i + 1) % c.size()]); };
  for (std::size_t i = 0; i < c.size(); ++i)
    add_grid(division, std::array{c[i], middle(i), centre, middle((i + c.size() - 1) % c.size())},
             along, along);
  return division;
}

Division divide_face(const Face& face, int refine, const Cuts& cuts) {
  const Cutting cutting = make_cutting(face, refine, cuts);
  const Rows rows = find_rows(cutting);
  Division division;
  if (cutting.crossing.empty())
    division = divide_face(face, refine);
  else if (rows.others.empty())
    division = make_grid(cutting, rows, find_grid(face, refine));
  else
    division = divide_freely(cutting, rows);
  division.contacts = find_edges(division, cutting.contacts, cutting.normal);
  std::vector<Line> all = cutting.contacts;
  all.insert(all.end(), cutting.creases.begin(), cutting.creases.end());
  division.creases = find_edges(division, all, cutting.normal);
  division.left_out += rows.left_out;
  return division;
}

}  // namespace radiosity
