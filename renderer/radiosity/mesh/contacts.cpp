#include "renderer/radiosity/mesh/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/errors.hpp"

namespace radiosity {

namespace {

constexpr double OFF_PLANE = 1e-6;  // share of a face's size
// What hangs over a face no higher than this touches it; a share of a patch's width.
constexpr double GAP = 0.2;
// Under an edge, as many gaps away from it, a tenth of the light that the edge gets is left.
constexpr double GAPS_INSIDE = 2;
// Pairs of faces that may touch: in any room, and for each of its faces.
constexpr std::size_t MOST_PAIRS = 1'000'000, MOST_PAIRS_PER_FACE = 100;

struct Flat {
  const Face* face;
  Plane plane;
  std::vector<Plane> edges;  // their insides are above
  renderer::Bounds bounds;
  double size;
  double width;        // its area over its longest edge
  double patch_width;  // as if it were divided evenly

  double gap() const { return GAP * patch_width; }
  double reach() const { return std::max(OFF_PLANE * size, gap()); }
};

Flat make_flat(const Face& face, int refine) {
  const auto& corners = face.corners;
  const Vec normal = eval_area_normal(corners);
  const auto bounds = renderer::make_bounds(corners);
  double longest = 0, narrowest = INFINITY;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const double edge = length(corners[(i + 1) % corners.size()] - corners[i]);
    const int steps = corners.size() != 4 ? 2 * face.along : i % 2 == 0 ? face.along : face.across;
    longest = std::max(longest, edge);
    narrowest = std::min(narrowest, edge / steps / refine);
  }
  return {&face,
          make_plane(normalize(normal), eval_mean(corners)),
          make_edge_planes(corners, normalize(normal)),
          bounds,
          length(bounds.hi - bounds.lo),
          length(normal) / 2 / longest,
          narrowest};
}

// Two faces that may touch, seen from the first.
struct Pair {
  const Flat& on;
  const Flat& other;
  double tolerance;
};

Pair make_pair(const Flat& on, const Flat& other) {
  return {on, other, OFF_PLANE * std::max(on.size, other.size)};
}

// The axis along which the bounds of the faces overlap least.
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

// Whether the bounds touch within a distance.
bool touch(const Flat& a, const Flat& b, double distance) {
  for (int axis = 0; axis < 3; ++axis)
    if (b.bounds.lo[axis] > a.bounds.hi[axis] + distance ||
        a.bounds.lo[axis] > b.bounds.hi[axis] + distance)
      return false;
  return true;
}

// Whether one face is large enough to hang over the other, see hangs_over().
bool may_hang(const Flat& other, const Flat& on) {
  return other.width >= on.patch_width && touch(other, on, on.gap());
}

// By face, the others that may touch it. BadInput where they are too many.
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
                     "found one of more than {} pairs of faces that touch or nearly so, expected "
                     "fewer: are faces there many times?",
                     most);
      neighbours[order[i]].push_back(order[k]);
      neighbours[order[k]].push_back(order[i]);
    }
  for (auto& some : neighbours) std::ranges::sort(some);
  return neighbours;
}

// The part of a segment that is at least `margin` inside the face's edges, if it has a length.
std::optional<Crease> clip_to(const Flat& flat, const Crease& segment, double margin,
                              double tolerance) {
  const auto part = clip_segment(segment.a, segment.b, flat.edges, margin);
  if (!part || !((part->to - part->from) * length(segment.b - segment.a) > 2 * tolerance))
    return std::nullopt;
  return Crease{lerp(segment.a, segment.b, part->from), lerp(segment.a, segment.b, part->to)};
}

bool are_coplanar(const Pair& pair) {
  return std::ranges::all_of(pair.other.face->corners, [&](const Vec& corner) {
    return std::abs(eval_height(pair.on.plane, corner)) <= pair.tolerance;
  });
}

// Whether faces in one plane have an area in common.
bool overlap(const Pair& pair) {
  std::vector<Vec> part = pair.on.face->corners;
  for (const Plane& edge : pair.other.edges) {
    part = clip(part, edge, pair.tolerance);
    if (part.empty()) return false;
  }
  return length(eval_area_normal(part)) > 4 * pair.tolerance * pair.on.size;
}

// The segment at which the other face meets the plane of the first, in front of it.
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

// How far the corners of the other face are in front of the first; of a two-sided one, before the
// side that they are on.
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

// Whether the other face hangs so near to the first, and is so wide, that patches of the first
// cannot show how light fades under its edges.
bool hangs_over(const Pair& pair) {
  const auto [low, high] = find_heights(pair);
  return low > pair.tolerance && high <= pair.on.gap() && pair.other.width >= pair.on.patch_width &&
         overlap(pair);
}

bool has_corner(const Flat& flat, const Vec& corner, double tolerance) {
  return std::ranges::any_of(flat.face->corners,
                             [&](const Vec& other) { return length(other - corner) <= tolerance; });
}

// Whether the way in under an edge of what hangs over a face is shut: by what stands on the face
// there, or since something else goes on hanging beyond the edge.
bool is_shut(const Pair& hanging, const Crease& edge, std::span<const Flat> flats,
             std::span<const std::uint32_t> neighbours) {
  return std::ranges::any_of(neighbours, [&](std::uint32_t i) {
    const Flat& flat = flats[i];
    if (&flat == &hanging.other || !has_corner(flat, edge.a, hanging.tolerance) ||
        !has_corner(flat, edge.b, hanging.tolerance))
      return false;
    const Pair pair = make_pair(hanging.on, flat);
    return find_heights(pair).low <= pair.tolerance || hangs_over(pair);
  });
}

Vec project(const Plane& plane, const Vec& p) { return p - eval_height(plane, p) * plane.normal; }

// Adds the open edges of what hangs over a face.
void add_hanging(const Pair& pair, std::span<const Flat> flats,
                 std::span<const std::uint32_t> neighbours, Contacts& contacts) {
  const Plane& plane = pair.on.plane;
  const auto& corners = pair.other.face->corners;
  const Vec middle = project(plane, eval_mean(corners));
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Crease edge{corners[i], corners[(i + 1) % corners.size()]};
    if (is_shut(pair, edge, flats, neighbours)) continue;
    const auto line = clip_to(pair.on, {project(plane, edge.a), project(plane, edge.b)},
                              pair.tolerance, pair.tolerance);
    if (!line) continue;
    contacts.lines.push_back(*line);
    const Vec across = normalize(cross(plane.normal, line->b - line->a));
    const double side = dot(across, middle - line->a) > 0 ? 1 : -1;
    const Vec inside = side * GAPS_INSIDE * find_heights(pair).high * across;
    contacts.inside.push_back({line->a + inside, line->b + inside});
  }
}

// Whether the surface of a face goes on beyond a segment of its border, in another face.
bool goes_on(const Flat& on, const Crease& border, std::span<const Flat> flats,
             std::span<const std::uint32_t> neighbours) {
  return std::ranges::any_of(neighbours, [&](std::uint32_t i) {
    const Pair pair = make_pair(on, flats[i]);
    return (dot(on.plane.normal, flats[i].plane.normal) > 0 || flats[i].face->two_sided) &&
           are_coplanar(pair) && clip_to(flats[i], border, -pair.tolerance, pair.tolerance);
  });
}

}  // namespace

std::vector<Contacts> find_contacts(const Room& room, int refine) {
  std::vector<Flat> flats;
  for (const Face& face : room.faces) flats.push_back(make_flat(face, refine));
  const auto neighbours = find_neighbours(flats);
  std::vector<Contacts> contacts(flats.size());
  for (std::size_t f = 0; f < flats.size(); ++f) {
    const Flat& on = flats[f];
    if (room.materials[on.face->material].mirror) continue;
    auto& lines = contacts[f].lines;
    for (const auto i : neighbours[f]) {
      const Pair pair = make_pair(on, flats[i]);
      const double tolerance = pair.tolerance;
      if (hangs_over(pair)) {
        add_hanging(pair, flats, neighbours[f], contacts[f]);
      } else if (are_coplanar(pair)) {
        if (!overlap(pair)) continue;
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
      }
    }
  }
  return contacts;
}

}  // namespace radiosity
