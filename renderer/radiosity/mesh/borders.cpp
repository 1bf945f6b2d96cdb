#include "renderer/radiosity/mesh/borders.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <numeric>

#include "renderer/radiosity/mesh/divide.hpp"

namespace radiosity {

namespace {

std::pair<std::uint32_t, std::uint32_t> edge_of(const Patch& patch, std::size_t side) {
  return std::minmax(patch.corners[side], patch.corners[(side + 1) % 4]);
}

std::size_t corner_at(const Patch& patch, std::uint32_t vertex) {
  return static_cast<std::size_t>(std::ranges::find(patch.corners, vertex) - patch.corners.begin());
}

// True if the patches share an edge that ends at the vertex and is not a crease.
bool are_joined(const Patch& a, const Patch& b, std::uint32_t vertex, const Edges& creases) {
  const auto i = corner_at(a, vertex), j = corner_at(b, vertex);
  for (const auto side : {i, (i + 3) % 4})
    for (const auto other : {j, (j + 3) % 4})
      if (edge_of(a, side) == edge_of(b, other) && !creases.contains(edge_of(a, side))) return true;
  return false;
}

// By patch around a vertex: its group, as the index in `around` of the group's first patch. Patches
// that share an edge are in one group unless the edge is a crease.
std::vector<std::size_t> find_groups(const Mesh& mesh, std::span<const std::uint32_t> around,
                                     std::uint32_t vertex, const Edges& creases) {
  std::vector<std::size_t> group(around.size());
  std::iota(group.begin(), group.end(), std::size_t{0});
  for (std::size_t a = 0; a < around.size(); ++a)
    for (std::size_t b = a + 1; b < around.size(); ++b)
      if (group[a] != group[b] &&
          are_joined(mesh.patches[around[a]], mesh.patches[around[b]], vertex, creases)) {
        const auto [low, high] = std::minmax(group[a], group[b]);
        std::ranges::replace(group, high, low);
      }
  return group;
}

// Returns the given edges with the new numbers of vertices that have been split. `before` has the
// corners of the patches before the split.
Edges rename(const Mesh& mesh, std::span<const std::array<std::uint32_t, 4>> before,
             const Edges& edges) {
  Edges renamed;
  for (std::size_t p = 0; p < before.size(); ++p)
    for (std::size_t side = 0; side < 4; ++side)
      if (edges.contains(std::minmax(before[p][side], before[p][(side + 1) % 4])))
        renamed.insert(edge_of(mesh.patches[p], side));
  return renamed;
}

// True if a point in the patch's plane lies on the patch, including its border up to rounding.
bool is_on(const Patch& patch, const Vec& point) {
  const double tolerance = 1e-9 * patch.area;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec &a = patch.at[i], &b = patch.at[(i + 1) % 4];
    if (dot(patch.normal, cross(b - a, point - a)) < -tolerance) return false;
  }
  return true;
}

// Finds a crease that lies too near to the point `at` to be an edge of the mesh: at most `width`
// times CREASE_TOUCH away. The vector `way` begins at this point. Returns the fraction of `way` at
// which the crease crosses `way`. Returns 0 if they do not cross, or only at a small angle.
double find_crossing(const Vec& at, const Vec& way, const Vec& normal, const Crease& crease,
                     double width) {
  constexpr double STEEP = 0.3;  // smallest sine of the angle between way and crease
  const Vec along = crease.b - crease.a, to = crease.a - at;
  const double off = dot(normal, cross(to, along)), across = dot(normal, cross(way, along));
  if (!(std::abs(off) <= CREASE_TOUCH * width * length(along)) ||
      !(std::abs(across) > STEEP * length(way) * length(along)))
    return 0;
  const double place = dot(normal, cross(to, way)) / across;
  return place >= 0 && place <= 1 ? off / across : 0;
}

// The distance z0 from a border at which the light of a patch behind a gap along the border is
// computed. Distances and the width w of the gap are in lengths of the patch. Light through a long
// gap gives the illumination f(z) = (1 - z / sqrt(z^2 + w^2)) / 2 at the distance z. z0 is chosen
// so that the mean of the patch's two ends, (f(z0) + f(1)) / 2, equals the mean of f over the
// patch.
double eval_lit_place(double width) {
  constexpr double NONE = 1e-9;
  if (width < NONE) return 0;
  const double slope = std::hypot(1, width);
  const double sine = 2 * slope - 2 * width - 1 / slope;  // z0 / sqrt(z0^2 + w^2)
  return width * sine / std::sqrt(1 - sine * sine);
}

// The light of a vertex on a border is computed at a point inside the surface. Returns the fraction
// of the vector `way` from the vertex at which this point lies.
double find_inset(const Vec& at, const Vec& way, const Vec& normal, const Fringe& fringe,
                  double inset) {
  constexpr double MOST = 0.5;
  double share = inset;
  if (inset == 0) return share;
  for (const Crease& crease : fringe.creases)
    if (const double t = find_crossing(at, way, normal, crease, fringe.width);
        t > inset && t <= MOST)
      share = std::max(share, t + inset);
  // Allows for light that enters through a gap of this width, between the border and an edge
  // parallel to it. `inside` is the unit vector away from the border.
  const auto light_through = [&](double width, const Vec& inside) {
    constexpr double WIDE = 4;  // gap width, in patches, from which the light is even
    const double depth = 2 * std::abs(dot(way, inside));  // extent of the patch behind the border
    if (width < WIDE * depth) share = std::max(share, 2 * eval_lit_place(width / depth));
  };
  const double touch = 2 * CONTACT_TOUCH * fringe.width;
  for (const auto& [below, inward, above] : fringe.contacts.hanging)
    if (eval_distance(at, below.a, below.b) <= touch)
      light_through(std::abs(eval_height(above, at) / dot(above.normal, normal)), inward);
  for (const Ledge& ledge : fringe.contacts.ledges) {
    if (eval_distance(at, ledge.foot.a, ledge.foot.b) > touch) continue;
    const Vec up = cross(normal, normalize(ledge.foot.b - ledge.foot.a));
    light_through(eval_width(ledge, at), dot(way, up) > 0 ? up : -up);
  }
  return share;
}

// By vertex: true if the vertex lies on an edge that belongs to only one patch.
std::vector<bool> find_borders(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Patch& patch : mesh.patches)
    for (std::size_t side = 0; side < 4; ++side) ++sides[edge_of(patch, side)];
  std::vector<bool> is_border(mesh.vertices.size());
  for (const auto& [edge, count] : sides)
    if (count == 1) is_border[edge.first] = is_border[edge.second] = true;
  return is_border;
}

// By vertex: the sum of the angles of the patches around it, in radians.
std::vector<double> find_angles(const Mesh& mesh) {
  std::vector<double> angles(mesh.vertices.size());
  for (const Patch& patch : mesh.patches)
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec a = patch.at[(i + 1) % 4] - patch.at[i], b = patch.at[(i + 3) % 4] - patch.at[i];
      angles[patch.corners[i]] += std::atan2(length(cross(a, b)), dot(a, b));
    }
  return angles;
}

// Finds the feet of upright edges: vertices where a contact line turns and the face covers more
// than half of the surroundings. The shadow of an upright edge narrows to a point at its foot.
// There, the limit of the light depends on the direction from which the point is approached.
std::set<std::uint32_t> find_feet(const Mesh& mesh, const Edges& contacts) {
  // Tolerance for rounding at a straight contact line.
  constexpr double MORE_THAN_HALF = 1.05 * std::numbers::pi;
  const auto angles = find_angles(mesh);
  std::set<std::uint32_t> feet;
  for (const auto& [a, b] : contacts)
    for (const auto v : {a, b})
      if (angles[v] > MORE_THAN_HALF) feet.insert(v);
  return feet;
}

// Splits the given vertices. Creases separate the patches around a vertex into groups; each group
// gets its own copy of the vertex.
void split_at(Mesh& mesh, const std::set<std::uint32_t>& vertices, const Edges& creases) {
  const auto surroundings = find_surroundings(mesh);
  for (const auto vertex : vertices) {
    const auto around = surroundings.of(vertex);
    const auto group = find_groups(mesh, around, vertex, creases);
    std::map<std::size_t, std::uint32_t> vertex_of{{0, vertex}};
    for (std::size_t i = 0; i < around.size(); ++i) {
      const auto [known, added] =
          vertex_of.emplace(group[i], static_cast<std::uint32_t>(mesh.vertices.size()));
      if (added) mesh.vertices.push_back(Vertex(mesh.vertices[vertex]));
      auto& patch = mesh.patches[around[i]];
      patch.corners[corner_at(patch, vertex)] = known->second;
    }
  }
}

// For the vertices on a border, sets Vertex::lit, the point where the light is computed.
void inset_borders(Mesh& mesh, const std::vector<bool>& is_border, double inset,
                   std::span<const Fringe> fringes) {
  const auto surroundings = find_surroundings(mesh);
  for (std::uint32_t v = 0; v < mesh.vertices.size(); ++v) {
    if (!is_border[v]) continue;
    const auto around = surroundings.of(v);
    Vec centre;
    for (const auto patch : around)
      centre += (1.0 / static_cast<double>(around.size())) * mesh.patches[patch].centre;
    const Patch& first = mesh.patches[around[0]];
    const auto move_to = [&](const Vec& inside) {
      const Vec& at = mesh.vertices[v].at;
      const Vec way = inside - at;
      mesh.vertices[v].lit =
          at + find_inset(at, way, first.normal, fringes[first.face], inset) * way;
    };
    move_to(centre);
    // If an object stands on the floor, the mean of the patches' centres may lie under the object.
    // The point then lies towards the centre of the largest patch instead.
    const auto holds = [&](std::uint32_t p) {
      return is_on(mesh.patches[p], mesh.vertices[v].lit);
    };
    const auto area = [&](std::uint32_t p) { return mesh.patches[p].area; };
    if (std::ranges::none_of(around, holds))
      move_to(mesh.patches[*std::ranges::max_element(around, {}, area)].centre);
  }
}

}  // namespace

void split_at_creases(Mesh& mesh, const Edges& creases) {
  std::set<std::uint32_t> ends;
  for (const auto& [a, b] : creases) ends.insert({a, b});
  split_at(mesh, ends, creases);
}

void split_and_inset(Mesh& mesh, const Edges& creases, const Edges& contacts, double inset,
                     std::span<const Fringe> fringes) {
  std::vector<std::array<std::uint32_t, 4>> before;
  for (const Patch& patch : mesh.patches) before.push_back(patch.corners);
  split_at_creases(mesh, contacts);
  auto is_border = find_borders(mesh);
  const auto feet = find_feet(mesh, rename(mesh, before, contacts));
  split_at(mesh, feet, rename(mesh, before, creases));
  for (const auto foot : feet) is_border[foot] = true;
  is_border.resize(mesh.vertices.size(), true);  // split_at() adds only vertices on borders
  inset_borders(mesh, is_border, inset, fringes);
  split_at_creases(mesh, rename(mesh, before, creases));
}

}  // namespace radiosity
