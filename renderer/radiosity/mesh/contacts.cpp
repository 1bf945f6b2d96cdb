#include "renderer/radiosity/mesh/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <ranges>

#include "base/errors.hpp"
#include "renderer/radiosity/mesh/divide.hpp"

namespace radiosity {

namespace {

constexpr double OFF_PLANE = 1e-6;  // share of a face's size
constexpr double GAP = 0.2;         // share of a patch's width
// So many gaps under a face's edge a tenth of the light is left that falls in through the gap.
constexpr double GAPS_ASIDE = 2;
// Pairs of faces with bounds that touch: in any room, and for each of its faces.
constexpr std::size_t MOST_PAIRS = 1'000'000, MOST_PAIRS_PER_FACE = 100;

struct Flat {
  const Face* face;
  Plane plane;
  std::vector<Plane> edges;  // their insides are above
  renderer::Bounds bounds;
  double size;
  double width;  // of a patch

  // What is nearer than this may be in contact.
  double reach() const { return std::max(OFF_PLANE * size, GAP * width); }
};

Flat make_flat(const Face& face, int refine) {
  const Vec normal = normalize(eval_area_normal(face.corners));
  const auto bounds = renderer::make_bounds(face.corners);
  return {&face,
          make_plane(normal, eval_mean(face.corners)),
          make_edge_planes(face.corners, normal),
          bounds,
          length(bounds.hi - bounds.lo),
          find_patch_width(face, refine)};
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

// By face, the others whose bounds are within reach of its. BadInput where they are too many.
std::vector<std::vector<std::uint32_t>> find_neighbours(std::span<const Flat> flats) {
  const int axis = choose_axis(flats);
  std::vector<std::uint32_t> order(flats.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto start = [&](std::uint32_t i) { return flats[i].bounds.lo[axis]; };
  std::ranges::stable_sort(order, {}, start);
  std::vector<std::vector<std::uint32_t>> neighbours(flats.size());
  double largest = 0;
  for (const Flat& flat : flats) largest = std::max(largest, flat.reach());
  const std::size_t most = MOST_PAIRS + MOST_PAIRS_PER_FACE * flats.size();
  std::size_t pairs = 0;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const auto &a = flats[order[i]].bounds, &b = flats[order[k]].bounds;
      if (b.lo[axis] > a.hi[axis] + largest) break;
      const double reach = std::max(flats[order[i]].reach(), flats[order[k]].reach());
      const auto apart = [&](int other) {
        return b.lo[other] > a.hi[other] + reach || a.lo[other] > b.hi[other] + reach;
      };
      if (apart(0) || apart(1) || apart(2)) continue;
      if (++pairs > most)
        base::refuse(flats[order[i]].face->where,
                     "found one of more than {} pairs of faces that touch, expected fewer: are "
                     "faces there many times?",
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

// Whether the other face hangs so near to the first, and is so large, that light changes by a leap
// at its outline.
bool hangs_over(const Pair& pair) {
  const auto height = [&](const Vec& corner) { return eval_height(pair.on.plane, corner); };
  const auto [low, high] =
      std::ranges::minmax(pair.other.face->corners | std::views::transform(height));
  const bool is_near = low > pair.tolerance && high <= GAP * pair.on.width;
  const bool is_behind = high < -pair.tolerance && low >= -GAP * pair.on.width;
  return (is_near || (pair.on.face->two_sided && is_behind)) && pair.other.size >= pair.on.width &&
         overlap(pair);
}

// The other face's edges, moved into the plane of the first.
std::vector<Crease> project_outline(const Pair& pair) {
  std::vector<Crease> edges;
  std::vector<Vec> corners = pair.other.face->corners;
  for (Vec& corner : corners)
    corner = corner - eval_height(pair.on.plane, corner) * pair.on.plane.normal;
  for (std::size_t i = 0; i < corners.size(); ++i)
    edges.push_back({corners[i], corners[(i + 1) % corners.size()]});
  return edges;
}

// Adds where light is as if the other face touched the first at this part of its outline.
void add_beside(const Pair& pair, const Crease& line, std::vector<Crease>& beside) {
  double gap = 0;
  for (const Vec& corner : pair.other.face->corners)
    gap = std::max(gap, std::abs(eval_height(pair.on.plane, corner)));
  if (gap <= pair.tolerance) return;
  const Vec aside = gap * GAPS_ASIDE * normalize(cross(pair.on.plane.normal, line.b - line.a));
  for (const Vec& by : {aside, -aside}) beside.push_back({line.a + by, line.b + by});
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
    auto& [lines, beside] = contacts[f];
    for (const auto i : neighbours[f]) {
      const Pair pair = make_pair(on, flats[i]);
      const double tolerance = pair.tolerance;
      if (are_coplanar(pair) ? overlap(pair) : hangs_over(pair)) {
        for (const Crease& edge : project_outline(pair)) {
          const auto part = clip_to(on, edge, tolerance, tolerance);
          if (!part) continue;
          lines.push_back(*part);
          add_beside(pair, *part, beside);
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
