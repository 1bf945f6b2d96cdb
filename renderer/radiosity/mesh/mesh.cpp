#include "renderer/radiosity/mesh/mesh.hpp"

#include <algorithm>
#include <map>
#include <numbers>
#include <numeric>
#include <optional>

#include "renderer/radiosity/mesh/contacts.hpp"
#include "renderer/radiosity/mesh/divide.hpp"
#include "renderer/radiosity/mesh/grade.hpp"
#include "renderer/radiosity/mesh/weld.hpp"
#include "renderer/scene/require.hpp"

namespace radiosity {

namespace {

// Number of patches that creases may always produce in a room, however few it has without. In a
// single face, creases may multiply the number of patches by up to MOST_FACE_GROWTH.
constexpr std::size_t MOST_ANYHOW = 2000;
constexpr int MOST_FACE_GROWTH = 64;
// Largest step of the illumination in a penumbra, relative to the mean illumination that the room
// would have if it were closed.
constexpr double STEP = 0.005;

std::pair<std::uint32_t, std::uint32_t> edge_of(const Patch& patch, std::size_t side) {
  return std::minmax(patch.corners[side], patch.corners[(side + 1) % 4]);
}

std::size_t corner_at(const Patch& patch, std::uint32_t vertex) {
  return static_cast<std::size_t>(std::ranges::find(patch.corners, vertex) - patch.corners.begin());
}

// True if the patches share an edge at the vertex, and the edge is not a crease.
bool are_joined(const Patch& a, const Patch& b, std::uint32_t vertex, const Edges& creases) {
  const auto i = corner_at(a, vertex), j = corner_at(b, vertex);
  for (const auto side : {i, (i + 3) % 4})
    for (const auto other : {j, (j + 3) % 4})
      if (edge_of(a, side) == edge_of(b, other) && !creases.contains(edge_of(a, side))) return true;
  return false;
}

// The group of each patch around a vertex, as the index of the group's first patch. Creases
// separate groups.
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

// The edges with new vertex numbers after vertices were split. `before` has the corners of the
// patches before the split.
Edges rename(const Mesh& mesh, std::span<const std::array<std::uint32_t, 4>> before,
             const Edges& edges) {
  Edges renamed;
  for (std::size_t p = 0; p < before.size(); ++p)
    for (std::size_t side = 0; side < 4; ++side)
      if (edges.contains(std::minmax(before[p][side], before[p][(side + 1) % 4])))
        renamed.insert(edge_of(mesh.patches[p], side));
  return renamed;
}

// True if a point of the patch's plane lies on the patch, or within rounding on its border.
bool is_on(const Patch& patch, const Vec& point) {
  const double tolerance = 1e-9 * patch.area;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec &a = patch.at[i], &b = patch.at[(i + 1) % 4];
    if (dot(patch.normal, cross(b - a, point - a)) < -tolerance) return false;
  }
  return true;
}

// Lines near a face's border. They determine at what distance from the border the light of its
// vertices is computed.
struct Fringe {
  std::vector<Crease> creases;  // creases and contacts of the face
  const Contacts& contacts;
  double width;  // width of a patch
};

// The share of `way` at which `way` crosses the crease, if the crease is too near to be kept: at
// most `width` times CREASE_TOUCH from `at`. 0 if they do not cross, or only at a low angle.
double find_crossing(const Vec& at, const Vec& way, const Vec& normal, const Crease& crease,
                     double width) {
  constexpr double STEEP = 0.3;  // least sine of the angle between way and crease
  const Vec along = crease.b - crease.a, to = crease.a - at;
  const double off = dot(normal, cross(to, along)), across = dot(normal, cross(way, along));
  if (!(std::abs(off) <= CREASE_TOUCH * width * length(along)) ||
      !(std::abs(across) > STEEP * length(way) * length(along)))
    return 0;
  const double place = dot(normal, cross(to, way)) / across;
  return place >= 0 && place <= 1 ? off / across : 0;
}

// The distance z0 from a border at which to compute the light of a patch behind a gap along the
// border. Distances and the gap's width w are in lengths of the patch. A long gap gives the
// illumination f(z) = (1 - z / sqrt(z^2 + w^2)) / 2 at the distance z. z0 is chosen so that (f(z0)
// + f(1)) / 2, the mean of the patch's ends, equals the mean of f over the patch.
double eval_lit_place(double width) {
  constexpr double NONE = 1e-9;
  if (width < NONE) return 0;
  const double slope = std::hypot(1, width);
  const double sine = 2 * slope - 2 * width - 1 / slope;  // sine z0 / sqrt(z0^2 + w^2)
  return width * sine / std::sqrt(1 - sine * sine);
}

// The share of the way from a border vertex to a point inside at which the vertex's light is
// computed.
double find_inset(const Vec& at, const Vec& way, const Vec& normal, const Fringe& fringe,
                  double inset) {
  constexpr double MOST = 0.5;
  double share = inset;
  if (inset == 0) return share;
  for (const Crease& crease : fringe.creases)
    if (const double t = find_crossing(at, way, normal, crease, fringe.width);
        t > inset && t <= MOST)
      share = std::max(share, t + inset);
  // Accounts for light that enters through a gap of this width between the border and an edge
  // parallel to it. `inside` is a unit vector.
  const auto light_through = [&](double width, const Vec& inside) {
    constexpr double WIDE = 4;  // gap width, in patches, beyond which the light is even
    const double depth = 2 * std::abs(dot(way, inside));  // depth of the patch behind the border
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

// For each vertex, whether it lies on an edge that belongs to one patch only.
std::vector<bool> find_borders(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> sides;
  for (const Patch& patch : mesh.patches)
    for (std::size_t side = 0; side < 4; ++side) ++sides[edge_of(patch, side)];
  std::vector<bool> is_border(mesh.vertices.size());
  for (const auto& [edge, count] : sides)
    if (count == 1) is_border[edge.first] = is_border[edge.second] = true;
  return is_border;
}

// For each vertex, the sum of the angles of its patches.
std::vector<double> find_angles(const Mesh& mesh) {
  std::vector<double> angles(mesh.vertices.size());
  for (const Patch& patch : mesh.patches)
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec a = patch.at[(i + 1) % 4] - patch.at[i], b = patch.at[(i + 3) % 4] - patch.at[i];
      angles[patch.corners[i]] += std::atan2(length(cross(a, b)), dot(a, b));
    }
  return angles;
}

// Finds the feet of upright edges: vertices at which a contact turns and the face fills more than a
// half-plane. The shadow of an upright edge narrows to a point at its foot, where the limit of the
// light depends on the direction of approach.
std::set<std::uint32_t> find_feet(const Mesh& mesh, const Edges& contacts) {
  // tolerance for rounding of a straight contact
  constexpr double MORE_THAN_HALF = 1.05 * std::numbers::pi;
  const auto angles = find_angles(mesh);
  std::set<std::uint32_t> feet;
  for (const auto& [a, b] : contacts)
    for (const auto v : {a, b})
      if (angles[v] > MORE_THAN_HALF) feet.insert(v);
  return feet;
}

// At each of these vertices, creases separate the surrounding patches into groups. Gives each
// group its own copy of the vertex.
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

// Sets Vertex::lit of the vertices on a border, as MeshParams::inset describes. `fringes` has one
// entry per face.
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
    // Where an object stands on the floor, the mean of the patches' centres may lie below the
    // object.
    const auto holds = [&](std::uint32_t p) {
      return is_on(mesh.patches[p], mesh.vertices[v].lit);
    };
    const auto area = [&](std::uint32_t p) { return mesh.patches[p].area; };
    if (std::ranges::none_of(around, holds))
      move_to(mesh.patches[*std::ranges::max_element(around, {}, area)].centre);
  }
}

// The face as seen from behind.
Face turn(Face face) {
  std::ranges::reverse(face.corners);
  std::ranges::reverse(face.normals);
  for (Vec& normal : face.normals) normal = -normal;
  if (face.corners.size() == 4) {  // along and across are exchanged
    std::swap(face.along, face.across);
    std::swap(face.grid.along, face.grid.across);
  }
  std::ranges::rotate(face.corners, face.corners.end() - 1);
  if (!face.normals.empty()) std::ranges::rotate(face.normals, face.normals.end() - 1);
  return face;
}

// A slightly larger polygon. Otherwise rays could pass between two faces if a corner of one lies in
// the middle of an edge of the other.
std::vector<Vec> grow(std::vector<Vec> corners) {
  constexpr double SHARE = 1e-9;
  const Vec centre = eval_centre(corners);
  for (Vec& corner : corners) corner += SHARE * (corner - centre);
  return corners;
}

void check_count(const Face& face, std::size_t patches) {
  renderer::require(patches <= MOST_PATCHES, face.where,
                    fmt::format("more than {} patches", MOST_PATCHES),
                    "fewer divisions (of the room's faces, or by refine)");
}

// Throws if the room has too many patches, before any are made.
void check_count(const Room& room, int refine) {
  std::size_t patches = 0;
  for (const Face& face : room.faces) {
    if (room.materials[face.material].mirror) continue;
    patches += (face.two_sided ? 2 : 1) * count_quads(face, refine);
    check_count(face, patches);
  }
}

// The normals of a face. If the face is part of a curved surface, they are interpolated.
class Normals {
 public:
  explicit Normals(const Face& face) : flat_(normalize(eval_area_normal(face.corners))) {
    if (!face.normals.empty())
      curved_ = renderer::make_patch(face.corners, face.normals, {}, corners_, normals_);
  }
  Vec at(const Vec& point) const {
    return curved_ ? renderer::eval_smooth_normal(*curved_, corners_, normals_, point) : flat_;
  }

 private:
  Vec flat_;
  std::optional<renderer::Patch> curved_;
  std::vector<renderer::PolygonCorner> corners_;
  std::vector<Vec> normals_;
};

class Builder {
 public:
  Builder(const Room& room, const MeshParams& params)
      : room_(room),
        params_(params),
        welder_(eval_bounds(room)),
        contacts_(find_contacts(room, params.refine)) {
    mesh_.materials = room.materials;
    mesh_.blockers.surfaces.emplace_back();
    mesh_.blockers.view = room.view;
  }

  Mesh build() {
    limit_cuts();
    for (std::uint32_t i = 0; i < room_.faces.size(); ++i) {
      Face face = room_.faces[i];
      for (Vec& corner : face.corners) corner += contacts_[i].lift;
      add(face, i);
    }
    finish(mesh_.blockers);
    // Contacts become borders. The light of points on a contact is computed slightly inside either
    // side.
    std::vector<std::array<std::uint32_t, 4>> before;
    for (const Patch& patch : mesh_.patches) before.push_back(patch.corners);
    split_at_creases(mesh_, touched_);
    auto is_border = find_borders(mesh_);
    const auto feet = find_feet(mesh_, rename(mesh_, before, touched_));
    split_at(mesh_, feet, rename(mesh_, before, creases_));
    for (const auto foot : feet) is_border[foot] = true;
    is_border.resize(mesh_.vertices.size(), true);  // copies of the feet are borders too
    inset_borders(mesh_, is_border, params_.inset, make_fringes());
    split_at_creases(mesh_, rename(mesh_, before, creases_));
    sum_up();
    return std::move(mesh_);
  }

 private:
  std::size_t count_with_cuts() const {
    std::size_t patches = 0;
    for (std::uint32_t i = 0; i < room_.faces.size(); ++i) {
      const Face& face = room_.faces[i];
      if (room_.materials[face.material].mirror) continue;
      patches +=
          (face.two_sided ? 2 : 1) * divide_face(face, params_.refine, make_cuts(i)).quads.size();
    }
    return patches;
  }

  std::size_t find_most_patches() const {
    const std::size_t plain = count_patches(room_, params_.refine);
    return std::max(MOST_ANYHOW, plain * static_cast<std::size_t>(params_.crease_growth));
  }

  // Removes strips and creases until the room is within its limit of patches.
  void limit_cuts() {
    growth_ = MOST_FACE_GROWTH;
    const std::size_t most = find_most_patches();
    if (!has_strips() && room_.creases.empty()) return;
    if (count_with_cuts() <= most) return;
    growth_ = 0;
    limit_strips(most / 2);
    limit_creases(most);
  }

  bool has_strips() const {
    return std::ranges::any_of(contacts_, [](const Contacts& c) { return !c.strips.empty(); });
  }

  // Halves the number of strips until the patches are at most `most`.
  void limit_strips(std::size_t most) {
    std::size_t strips = MOST_STRIPS;
    while (has_strips() && count_with_cuts() > most)
      contacts_ = find_contacts(room_, params_.refine, strips /= 2);
  }

  // Finds the largest growth per face that keeps the limit: first halves the growth, then raises it
  // by bisection.
  void limit_creases(std::size_t most) {
    growth_ = MOST_FACE_GROWTH;
    while (growth_ > 1 && count_with_cuts() > most) growth_ /= 2;
    if (growth_ == MOST_FACE_GROWTH) return;
    for (int more = growth_ / 2; more > 0; more /= 2) {
      growth_ += more;
      if (count_with_cuts() > most) growth_ -= more;
    }
  }

  // The lines that cut a face of the room.
  Cuts make_cuts(std::uint32_t face) const {
    const Contacts& contacts = contacts_[face];
    return {room_.creases, contacts.lines, contacts.folds, contacts.strips, growth_};
  }

  std::vector<Fringe> make_fringes() const {
    std::vector<Fringe> fringes;
    for (std::size_t f = 0; f < room_.faces.size(); ++f) {
      const Face& face = room_.faces[f];
      fringes.push_back({select_creases(face, room_.creases, 0), contacts_[f],
                         find_patch_width(face, params_.refine)});
    }
    return fringes;
  }

  void sum_up() {
    for (const Patch& patch : mesh_.patches) {
      const Material& material = mesh_.materials[patch.material];
      mesh_.area += patch.area;
      mesh_.emitted += patch.area * material.emission;
      mesh_.reflectance += patch.area * material.reflectance;
    }
    mesh_.reflectance = (1 / mesh_.area) * mesh_.reflectance;
    const double absorbed = mesh_.area * (1 - sum(mesh_.reflectance) / 3);
    if (room_.fine_shadows) mesh_.most_at_once = STEP * sum(mesh_.emitted) / 3 / absorbed;
  }

  void add(const Face& face, std::uint32_t number) {
    object_ = static_cast<std::uint32_t>(renderer::object_count(mesh_.blockers));
    renderer::add_polygon(mesh_.blockers, grow(face.corners));
    const bool mirror = mesh_.materials[face.material].mirror;
    for (const Face& side : face.two_sided ? std::vector{face, turn(face)} : std::vector{face})
      mirror ? add_mirror(side) : add_patches(side, number);
  }

  void add_mirror(const Face& face) {
    const Vec twice = eval_area_normal(face.corners);
    double longest = 0;
    for (std::size_t i = 0; i < face.corners.size(); ++i)
      longest = std::max(
          longest, length(face.corners[i] - face.corners[i ? i - 1 : face.corners.size() - 1]));
    mesh_.mirrors.push_back({face.corners, normalize(twice), eval_centre(face.corners),
                             length(twice) / 2 / longest, face.material, object_});
  }

  void add_patches(const Face& face, std::uint32_t number) {
    const Division division = divide_face(face, params_.refine, make_cuts(number));
    check_count(face, mesh_.patches.size() + division.quads.size());
    mesh_.left_out += division.left_out;
    const Normals normals(face);
    std::vector<std::uint32_t> index;
    for (const Vec& point : division.points) {
      const Vec normal = normals.at(point);
      index.push_back(welder_.weld(point, normal, face.material));
      if (index.back() == mesh_.vertices.size())
        mesh_.vertices.push_back({point, point, normal, face.material, object_});
    }
    for (const auto& [a, b] : division.creases) creases_.insert(std::minmax(index[a], index[b]));
    for (const auto& [a, b] : division.contacts) touched_.insert(std::minmax(index[a], index[b]));
    for (const auto& [a, b, c, d] : division.quads)
      add_patch({index[a], index[b], index[c], index[d]}, number);
  }

  void add_patch(const std::array<std::uint32_t, 4>& corners, std::uint32_t face) {
    std::array<Vec, 4> at;
    for (std::size_t k = 0; k < 4; ++k) at[k] = mesh_.vertices[corners[k]].at;
    const Vec twice = eval_area_normal(at);
    renderer::require(length(twice) > 0, room_.faces[face].where,
                      "patches smaller than 1e-9 of the room", "larger faces or fewer divisions");
    mesh_.patches.push_back({corners, at, eval_bilinear(at, 0.5, 0.5), normalize(twice),
                             length(twice) / 2, mesh_.vertices[corners[0]].material, object_,
                             face});
  }

  const Room& room_;
  const MeshParams& params_;
  Mesh mesh_;
  Welder welder_;
  std::vector<Contacts> contacts_;  // contacts of each face
  Edges creases_, touched_;         // edges on creases or contacts; edges on contacts
  std::uint32_t object_ = 0;
  int growth_ = 1;  // growth that make_cuts() passes to Cuts::growth
};

}  // namespace

Surroundings find_surroundings(const Mesh& mesh) {
  Surroundings found;
  found.first.assign(mesh.vertices.size() + 1, 0);
  for (const Patch& patch : mesh.patches)
    for (const auto corner : patch.corners) ++found.first[corner + 1];
  std::partial_sum(found.first.begin(), found.first.end(), found.first.begin());
  found.patches.resize(found.first.back());
  auto next = found.first;
  for (std::uint32_t i = 0; i < mesh.patches.size(); ++i)
    for (const auto corner : mesh.patches[i].corners) found.patches[next[corner]++] = i;
  return found;
}

void split_at_creases(Mesh& mesh, const Edges& creases) {
  std::set<std::uint32_t> ends;
  for (const auto& [a, b] : creases) ends.insert({a, b});
  split_at(mesh, ends, creases);
}

base::Fields<MeshParams> mesh_fields() {
  using D = base::Declare<MeshParams>;
  return {D::whole("refine", &MeshParams::refine, 1, 1000, "",
                   "multiplies the divisions of every face of the room"),
          D::whole("crease_growth", &MeshParams::crease_growth, 1, 1000, "",
                   "largest growth of the number of patches by creases (2000 patches are always "
                   "allowed); beyond it, creases of weak lamps are left out first")};
}

Mesh make_mesh(const Room& room, const MeshParams& params) {
  check_count(room, params.refine);
  if (!room.fine_near_lights) return Builder(room, params).build();
  const Room graded = make_graded(room, params.refine);
  check_count(graded, params.refine);
  return Builder(graded, params).build();
}

}  // namespace radiosity
