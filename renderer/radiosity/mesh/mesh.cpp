#include "renderer/radiosity/mesh/mesh.hpp"

#include <algorithm>
#include <numeric>
#include <optional>

#include "renderer/radiosity/mesh/borders.hpp"
#include "renderer/radiosity/mesh/contacts.hpp"
#include "renderer/radiosity/mesh/divide.hpp"
#include "renderer/radiosity/mesh/grade.hpp"
#include "renderer/radiosity/mesh/weld.hpp"
#include "renderer/scene/require.hpp"

namespace radiosity {

namespace {

// Number of patches that a room with creases may always have, even if it would have few patches
// without creases. In a single face, creases may multiply the number of patches by up to
// MOST_FACE_GROWTH.
constexpr std::size_t MOST_ANYHOW = 2000;
constexpr int MOST_FACE_GROWTH = 64;
// Largest step of the illumination in a penumbra, as a fraction of the mean illumination that the
// room would have if it were closed.
constexpr double STEP = 0.005;

// Returns a face turned round, for the patches of its second side.
Face turn(Face face) {
  std::ranges::reverse(face.corners);
  std::ranges::reverse(face.normals);
  for (Vec& normal : face.normals) normal = -normal;
  if (face.corners.size() == 4) {  // exchanges the directions along and across
    std::swap(face.along, face.across);
    std::swap(face.grid.along, face.grid.across);
  }
  std::ranges::rotate(face.corners, face.corners.end() - 1);
  if (!face.normals.empty()) std::ranges::rotate(face.normals, face.normals.end() - 1);
  return face;
}

// Makes a polygon slightly larger. Otherwise, rays could pass between two faces where a corner of
// one lies in the middle of an edge of the other.
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

// Throws BadInput if the room has too many patches, before any are made.
void check_count(const Room& room, int refine) {
  std::size_t patches = 0;
  for (const Face& face : room.faces) {
    if (room.materials[face.material].mirror) continue;
    patches += (face.two_sided ? 2 : 1) * count_quads(face, refine);
    check_count(face, patches);
  }
}

// The normals of a face. They are interpolated if the face is part of a curved surface.
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
    split_and_inset(mesh_, creases_, touched_, params_.inset, make_fringes());
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

  // Removes strips and creases until the room is within its limit on the number of patches.
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

  // Halves the number of strips until there are at most `most` patches.
  void limit_strips(std::size_t most) {
    std::size_t strips = MOST_STRIPS;
    while (has_strips() && count_with_cuts() > most)
      contacts_ = find_contacts(room_, params_.refine, strips /= 2);
  }

  // Finds the largest growth per face with at most `most` patches in the room: halves the growth,
  // then raises it by bisection.
  void limit_creases(std::size_t most) {
    growth_ = MOST_FACE_GROWTH;
    while (growth_ > 1 && count_with_cuts() > most) growth_ /= 2;
    if (growth_ == MOST_FACE_GROWTH) return;
    for (int more = growth_ / 2; more > 0; more /= 2) {
      growth_ += more;
      if (count_with_cuts() > most) growth_ -= more;
    }
  }

  // The lines along which the face with this number is divided.
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
  std::vector<Contacts> contacts_;  // by face
  Edges creases_, touched_;         // edges on creases or contacts, and edges on contacts only
  std::uint32_t object_ = 0;
  int growth_ = 1;  // value of Cuts::growth for make_cuts()
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
