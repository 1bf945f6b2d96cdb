#include "renderer/radiosity/mesh/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/errors.hpp"
#include "renderer/radiosity/mesh/lift.hpp"

namespace radiosity {

namespace {

// An open edge above a face makes strips of graded patches if its height is from LEAST_GAP to 1,
// relative to the width of a patch. A lower edge counts as touching the face. In a mesh without
// strips, edges up to the height TOUCHING_GAP also count as touching.
constexpr double LEAST_GAP = 0.01, TOUCHING_GAP = 0.5;
// The strips end at FIRST_STRIP, GROWTH * FIRST_STRIP and so on, in multiples of the edge's height,
// but at most at WIDEST_STRIP of a patch's width. At GROWTH times FIRST_STRIP, the illumination is
// still 15 % below its full value.
constexpr double FIRST_STRIP = 0.5, GROWTH = 2, WIDEST_STRIP = 0.6;
// A face narrower than a patch hangs over another face only up to this height, relative to its own
// width.
constexpr double NARROW_GAP = 0.06;
// Smallest cosine of the angle between the normals of a face and of a face that hangs over it.
constexpr double PARALLEL = 0.8;
// Limit on the number of pairs of faces that touch: a constant, plus a number for each face.
constexpr std::size_t MOST_PAIRS = 1'000'000, MOST_PAIRS_PER_FACE = 100;

// The axis along which the bounding boxes of the faces overlap least, for sweep and prune.
int choose_axis(std::span<const Flat> flats) {
  renderer::Bounds all;
  Vec extents;
  for (const Flat& flat : flats) {
    all = join(all, flat.bounds);
    extents += flat.bounds.hi - flat.bounds.lo;
  }
  const Vec whole = all.hi - all.lo;
  const auto share = [&](int axis) {
    return whole[axis] > 0 ? extents[axis] / whole[axis] : INFINITY;
  };
  return std::ranges::min({0, 1, 2}, {}, share);
}

// True if the bounding boxes are within `distance` of each other.
bool touch(const Flat& a, const Flat& b, double distance) {
  for (int axis = 0; axis < 3; ++axis)
    if (b.bounds.lo[axis] > a.bounds.hi[axis] + distance ||
        a.bounds.lo[axis] > b.bounds.hi[axis] + distance)
      return false;
  return true;
}

// The largest height at which `other` can hang over `on` (see hangs_over()).
double find_most_height(const Flat& other, const Flat& on) {
  return other.width >= on.patch_width ? on.gap() : std::min(on.gap(), NARROW_GAP * other.width);
}

// True if `other` is near enough to hang over `on` (see hangs_over()).
bool may_hang(const Flat& other, const Flat& on) {
  return touch(other, on, find_most_height(other, on));
}

// By face: the other faces that may touch it. Throws BadInput if there are too many pairs.
std::vector<std::vector<std::uint32_t>> find_neighbours(std::span<const Flat> flats) {
  const int axis = choose_axis(flats);
  std::vector<std::uint32_t> order(flats.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto start = [&](std::uint32_t i) { return flats[i].bounds.lo[axis] - flats[i].reach(); };
  std::ranges::stable_sort(order, {}, start);
  std::vector<std::vector<std::uint32_t>> neighbours(flats.size());
  const std::size_t most = MOST_PAIRS + MOST_PAIRS_PER_FACE * flats.size();
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const Flat &a = flats[order[i]], &b = flats[order[k]];
      if (start(order[k]) > a.bounds.hi[axis] + a.reach()) break;
      if (!touch(a, b, OFF_PLANE * std::max(a.size, b.size)) && !may_hang(a, b) && !may_hang(b, a))
        continue;
      if (++pairs > most)
        base::refuse(a.face->where,
                     "found a face in one of more than {} pairs that touch or nearly touch, "
                     "expected fewer: does the file repeat faces?",
                     most);
      neighbours[order[i]].push_back(order[k]);
      neighbours[order[k]].push_back(order[i]);
    }
  for (auto& some : neighbours) std::ranges::sort(some);
  return neighbours;
}

// The segment in which pair.other meets the plane of pair.on. None if this segment does not lie in
// front of pair.on.
std::optional<Crease> find_touch(const Pair& pair) {
  const auto& corners = pair.other.face->corners;
  std::vector<double> heights;
  for (const Vec& corner : corners) {
    const double height = eval_height(pair.on.plane, corner);
    heights.push_back(std::abs(height) <= pair.tolerance ? 0 : height);
  }
  if (!pair.on.face->two_sided && !(*std::ranges::max_element(heights) > 0)) return std::nullopt;
  std::vector<Vec> points;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const std::size_t next = (i + 1) % corners.size();
    const double here = heights[i], there = heights[next];
    if (here == 0) points.push_back(corners[i]);
    if ((here > 0 && there < 0) || (here < 0 && there > 0))
      points.push_back(lerp(corners[i], corners[next], here / (here - there)));
  }
  if (points.size() != 2) return std::nullopt;
  return Crease{points[0], points[1]};
}

// The smallest and largest height of the corners of pair.other above pair.on. If pair.on is
// two-sided and all corners are behind it, heights are measured from its back.
struct Heights {
  double low, high;
};
Heights find_heights(const Pair& pair) {
  Heights found{INFINITY, -INFINITY};
  for (const Vec& corner : pair.other.face->corners) {
    const double height = eval_height(pair.on.plane, corner);
    found = {std::min(found.low, height), std::max(found.high, height)};
  }
  return pair.on.face->two_sided && found.high < 0 ? Heights{-found.high, -found.low} : found;
}

// True if pair.other hangs over pair.on so low and is so wide that the patches of pair.on cannot
// resolve how the light fades under its edges.
bool hangs_over(const Pair& pair) {
  const auto [low, high] = find_heights(pair);
  const double most = find_most_height(pair.other, pair.on);
  return low > pair.tolerance && low <= most && high <= 2 * most &&
         std::abs(dot(pair.on.plane.normal, pair.other.plane.normal)) >= PARALLEL && overlap(pair);
}

bool lies_on(const Flat& flat, const Vec& point, double tolerance) {
  return std::abs(eval_height(flat.plane, point)) <= tolerance &&
         std::ranges::all_of(
             flat.edges, [&](const Plane& edge) { return eval_height(edge, point) >= -tolerance; });
}

// True if no light enters under `edge` of the hanging face. Either a face descends from the edge,
// or a face beyond the edge hangs equally low. `outward` points away from the hanging face in its
// plane. `neighbours` are the neighbours of the hanging face.
bool is_shut(const Pair& hanging, const Crease& edge, const Vec& outward,
             std::span<const Flat> flats, std::span<const std::uint32_t> neighbours) {
  const Vec middle = 0.5 * (edge.a + edge.b);
  const double tolerance = hanging.tolerance, low = find_heights(hanging).low;
  return std::ranges::any_of(neighbours, [&](std::uint32_t i) {
    const Flat& flat = flats[i];
    if (&flat == &hanging.other || !lies_on(flat, middle, tolerance)) return false;
    const Heights heights = find_heights(make_pair(hanging.on, flat));
    return heights.low < low - tolerance ||
           (heights.high <= hanging.on.gap() &&
            dot(outward, eval_mean(flat.face->corners) - middle) > tolerance);
  });
}

Vec project(const Plane& plane, const Vec& p) { return p - eval_height(plane, p) * plane.normal; }

// Planes through the edges of a hanging face, perpendicular to the face below. The hanging face is
// on their upper side.
std::vector<Plane> make_shape(const Pair& pair) {
  std::vector<Vec> below;
  for (const Vec& corner : pair.other.face->corners)
    below.push_back(project(pair.on.plane, corner));
  return make_edge_planes(below, normalize(eval_area_normal(below)));
}

// An edge of a hanging face under which light enters.
struct OpenEdge {
  const Pair pair;
  Crease below;                  // projection of the edge onto the lower face
  std::array<double, 2> height;  // heights of the two ends above the lower face
  Vec inward;  // unit vector in the plane of the lower face, towards the hanging face
};

// Adds the open edges of the hanging face pair.other. `neighbours` are the neighbours of this face.
void find_open_edges(const Pair& pair, std::span<const Flat> flats,
                     std::span<const std::uint32_t> neighbours, std::vector<OpenEdge>& open) {
  const Plane& plane = pair.on.plane;
  const auto& corners = pair.other.face->corners;
  const Vec middle = project(plane, eval_mean(corners));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Crease edge{corners[i], corners[(i + 1) % corners.size()]};
    const Crease below{project(plane, edge.a), project(plane, edge.b)};
    Vec inward = normalize(cross(plane.normal, below.b - below.a));
    if (dot(inward, middle - below.a) < 0) inward = -inward;
    const std::array height{length(edge.a - below.a), length(edge.b - below.b)};
    if (std::max(height[0], height[1]) <= pair.on.gap() &&
        !is_shut(pair, edge, -inward, flats, neighbours))
      open.push_back({pair, below, height, inward});
  }
}

// The segment below an edge, moved inwards by `heights` times the edge's height; outwards if
// `heights` is negative. A segment moved outwards is also extended by the same distance at both
// ends, so that neighbouring segments meet.
Crease shift(const OpenEdge& edge, double heights) {
  const Vec along = normalize(edge.below.b - edge.below.a);
  const double longer = std::max(0.0, -heights);
  return {edge.below.a + edge.height[0] * (heights * edge.inward - longer * along),
          edge.below.b + edge.height[1] * (heights * edge.inward + longer * along)};
}

// Adds an edge as if it touched the face, because it is so low that strips cannot resolve how the
// light fades.
void add_touching(const OpenEdge& edge, const Crease& line, Contacts& contacts) {
  contacts.lines.push_back(line);
  contacts.hanging.push_back({line, edge.inward, edge.pair.other.plane});
}

// Adds strips beside an edge, where the light fades. At the distance x outside of a long edge of
// the height h, the fraction (1 + x / sqrt(x^2 + h^2)) / 2 of the light arrives.
void add_strips(const OpenEdge& edge, std::size_t most, Contacts& contacts) {
  const Pair& pair = edge.pair;
  const auto shape = make_shape(pair);
  const double height = std::max(edge.height[0], edge.height[1]);
  double heights = FIRST_STRIP;
  for (std::size_t i = 0; i < most && heights * height <= WIDEST_STRIP * pair.on.patch_width;
       ++i, heights *= GROWTH) {
    if (const auto line = clip_to(pair.on, shift(edge, -heights), pair.tolerance, pair.tolerance))
      contacts.strips.push_back(*line);
    const Crease inner = shift(edge, heights);
    if (const auto part = clip_segment(inner.a, inner.b, shape, 0))
      if (const auto line = clip_to(
              pair.on, {lerp(inner.a, inner.b, part->from), lerp(inner.a, inner.b, part->to)},
              pair.tolerance, pair.tolerance))
        contacts.strips.push_back(*line);
  }
}

// Adds the contacts of a face with the edges that hang over it. All edges together get at most
// `most_strips` strips on each side, so that each of many edges gets few or none.
void add_hanging(std::span<const OpenEdge> edges, std::size_t most_strips, Contacts& contacts) {
  const std::size_t most = most_strips / std::max<std::size_t>(1, edges.size());
  for (const OpenEdge& edge : edges) {
    const Pair& pair = edge.pair;
    const auto line = clip_to(pair.on, edge.below, pair.tolerance, pair.tolerance);
    if (!line) continue;
    const auto [low, high] = std::minmax(edge.height[0], edge.height[1]);
    if (low < LEAST_GAP * pair.on.patch_width ||
        (most == 0 && high <= TOUCHING_GAP * pair.on.patch_width)) {
      add_touching(edge, *line, contacts);
      continue;
    }
    contacts.folds.push_back(*line);
    add_strips(edge, most, contacts);
  }
}

// True if another face continues the surface of `on` beyond a segment of its border.
bool goes_on(const Flat& on, const Crease& border, std::span<const Flat> flats,
             std::span<const std::uint32_t> neighbours) {
  return std::ranges::any_of(neighbours, [&](std::uint32_t i) {
    const Pair pair = make_pair(on, flats[i]);
    return (dot(on.plane.normal, flats[i].plane.normal) > 0 || flats[i].face->two_sided) &&
           are_coplanar(pair) && clip_to(flats[i], border, -pair.tolerance, pair.tolerance);
  });
}

// True if pair.on stands on the front of pair.other, which the border of pair.on touches.
bool stands_on(const Pair& pair, const Crease& border) {
  constexpr double MOST_COSINE = 0.5;
  const bool is_upright =
      std::abs(dot(pair.on.plane.normal, pair.other.plane.normal)) < MOST_COSINE;
  const bool is_before = find_heights({pair.other, pair.on, pair.tolerance}).high > pair.tolerance;
  return is_upright && is_before && !pair.on.face->two_sided &&
         clip_to(pair.other, border, pair.tolerance, pair.tolerance);
}

// Makes the ledge on pair.other in front of pair.on, which stands on it. `neighbours` are the
// neighbours of pair.other.
Ledge make_ledge(const Pair& pair, const Crease& foot, std::span<const Flat> flats,
                 std::span<const std::uint32_t> neighbours) {
  const Vec &normal = pair.on.plane.normal, &up = pair.other.plane.normal;
  Ledge ledge{foot, normalize(normal - dot(normal, up) * up), {}};
  const auto& corners = pair.other.face->corners;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Crease edge{corners[i], corners[(i + 1) % corners.size()]};
    const Vec inward = cross(up, edge.b - edge.a);
    if (length(inward) > 0 && !goes_on(pair.other, edge, flats, neighbours))
      ledge.edges.push_back(make_plane(normalize(inward), edge.a));
  }
  return ledge;
}

}  // namespace

double eval_width(const Ledge& ledge, const Vec& at) {
  constexpr double PARALLEL = 1e-6;
  double width = INFINITY;
  for (const Plane& edge : ledge.edges)
    if (const double slope = -dot(edge.normal, ledge.out); slope > PARALLEL)
      width = std::min(width, std::max(0.0, eval_height(edge, at)) / slope);
  return width;
}

std::vector<Contacts> find_contacts(const Room& room, int refine, std::size_t most_strips) {
  std::vector<Flat> flats;
  for (const Face& face : room.faces) flats.push_back(make_flat(face, refine));
  const auto neighbours = find_neighbours(flats);
  std::vector<Contacts> contacts(flats.size());
  for (std::size_t f = 0; f < flats.size(); ++f) {
    const Flat& on = flats[f];
    if (room.materials[on.face->material].mirror) continue;
    auto& lines = contacts[f].lines;
    std::vector<OpenEdge> open;
    for (const auto i : neighbours[f]) {
      const Pair pair = make_pair(on, flats[i]);
      const double tolerance = pair.tolerance;
      if (hangs_over(pair)) {
        find_open_edges(pair, flats, neighbours[i], open);
      } else if (are_coplanar(pair)) {
        // Faces that are covered by this face do not affect its front.
        const bool is_behind = !on.face->two_sided && covers(room, {flats[i], on, tolerance});
        if (!overlap(pair) || is_behind) continue;
        const auto& corners = flats[i].face->corners;
        for (std::size_t k = 0; k < corners.size(); ++k) {
          const Crease edge{corners[k], corners[(k + 1) % corners.size()]};
          if (const auto part = clip_to(on, edge, tolerance, tolerance)) lines.push_back(*part);
        }
      } else if (const auto touch = find_touch(pair)) {
        const bool is_inside = clip_to(on, *touch, tolerance, tolerance).has_value();
        const auto border = clip_to(on, *touch, -tolerance, tolerance);
        if (is_inside || (border && goes_on(on, *border, flats, neighbours[f])))
          lines.push_back(*border);
        else if (border && stands_on(pair, *border))
          contacts[f].ledges.push_back(make_ledge(pair, *border, flats, neighbours[i]));
      }
    }
    add_hanging(open, most_strips, contacts[f]);
  }
  const std::vector<Vec> lifts = find_lifts(room, flats, neighbours);
  for (std::size_t f = 0; f < flats.size(); ++f) contacts[f].lift = lifts[f];
  return contacts;
}

}  // namespace radiosity
