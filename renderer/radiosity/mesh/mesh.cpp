#include "renderer/radiosity/mesh/mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/errors.hpp"
#include "renderer/radiosity/mesh/divide.hpp"
#include "renderer/radiosity/mesh/split.hpp"
#include "renderer/radiosity/mesh/weld.hpp"
#include "renderer/scene/kernels.hpp"

namespace radiosity {

namespace {

constexpr std::size_t MOST_PATCHES = 10'000'000;

double eval_size(const Room& room) {
  double size = 0;
  for (const auto& face : room.faces)
    for (const Vec& corner : face.corners) size = std::max(size, renderer::max_abs(corner));
  return size;
}

// The face as it is seen from behind.
Face turn(Face face) {
  std::ranges::reverse(face.corners);
  std::ranges::reverse(face.normals);
  for (Vec& normal : face.normals) normal = -normal;
  if (face.corners.size() == 4) std::swap(face.along, face.across);  // the other edge is first
  std::ranges::rotate(face.corners, face.corners.end() - 1);
  if (!face.normals.empty()) std::ranges::rotate(face.normals, face.normals.end() - 1);
  return face;
}

Vec mean_of(const std::vector<Vec>& corners) {
  Vec mean;
  for (const Vec& corner : corners) mean += (1.0 / static_cast<double>(corners.size())) * corner;
  return mean;
}

// The polygon a little larger, so that no ray passes between faces that share an edge, however it
// is rounded.
std::vector<Vec> grow(std::vector<Vec> corners) {
  constexpr double SHARE = 1e-9;
  const Vec centre = mean_of(corners);
  for (Vec& corner : corners) corner += SHARE * (corner - centre);
  return corners;
}

// The number of quads of a face without creases.
std::size_t count_quads(const Face& face, int refine) {
  const auto along = static_cast<std::size_t>(face.along) * static_cast<std::size_t>(refine);
  const auto across = static_cast<std::size_t>(face.across) * static_cast<std::size_t>(refine);
  return face.corners.size() == 4 ? along * across : face.corners.size() * along * along;
}

void check_count(const Face& face, std::size_t patches) {
  if (patches > MOST_PATCHES)
    throw base::BadInput(
        fmt::format("{}: found more than {} patches, expected fewer divisions (of the "
                    "room's faces, or by refine)",
                    face.where, MOST_PATCHES));
}

// The normals of a face, interpolated if it stands for a curved surface.
class Normals {
 public:
  explicit Normals(const Face& face) : flat_(normalize(eval_area_normal(face.corners))) {
    if (!face.normals.empty())
      curved_ = renderer::make_patch(face.corners, face.normals, {}, corners_, normals_);
  }
  Vec at(const Vec& point) const {
    return curved_ ? renderer::eval_normal(*curved_, corners_.data(), normals_.data(), point)
                   : flat_;
  }

 private:
  Vec flat_;
  std::optional<renderer::Patch> curved_;
  std::vector<renderer::Corner> corners_;
  std::vector<Vec> normals_;
};

class Builder {
 public:
  Builder(const Room& room, const MeshParams& params)
      : room_(room), params_(params), welder_(eval_size(room)) {
    mesh_.materials = room.materials;
    mesh_.blockers.surfaces.emplace_back();
    mesh_.blockers.view = room.view;
  }

  Mesh build() {
    for (std::uint32_t i = 0; i < room_.faces.size(); ++i) add(room_.faces[i], i);
    finish(mesh_.blockers);
    inset_borders(mesh_, params_.inset);
    split_at_creases(mesh_, creases_);
    sum_up();
    return std::move(mesh_);
  }

 private:
  void sum_up() {
    for (const Patch& patch : mesh_.patches) {
      const Material& material = mesh_.materials[patch.material];
      mesh_.area += patch.area;
      mesh_.emitted += patch.area * material.emission;
      mesh_.reflectance += patch.area * material.reflectance;
    }
    mesh_.reflectance = (1 / mesh_.area) * mesh_.reflectance;
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
    mesh_.mirrors.push_back({face.corners, normalize(twice), mean_of(face.corners),
                             length(twice) / 2 / longest, face.material, object_});
  }

  void add_patches(const Face& face, std::uint32_t number) {
    check_count(face, mesh_.patches.size() + count_quads(face, params_.refine));
    const Division division = divide_face(face, params_.refine, room_.creases);
    check_count(face, mesh_.patches.size() + division.quads.size());
    const Normals normals(face);
    std::vector<std::uint32_t> index;
    for (const Vec& point : division.points) {
      const Vec normal = normals.at(point);
      index.push_back(welder_.weld(point, normal, face.material));
      if (index.back() == mesh_.vertices.size())
        mesh_.vertices.push_back({point, point, normal, face.material, object_});
    }
    for (const auto& [a, b] : division.creases) creases_.insert(std::minmax(index[a], index[b]));
    for (const auto& [a, b, c, d] : division.quads)
      add_patch({index[a], index[b], index[c], index[d]}, number);
  }

  void add_patch(const std::array<std::uint32_t, 4>& corners, std::uint32_t face) {
    std::array<Vec, 4> at;
    for (std::size_t k = 0; k < 4; ++k) at[k] = mesh_.vertices[corners[k]].at;
    const Vec twice = eval_area_normal(at);
    if (!(length(twice) > 0))
      throw base::BadInput(
          fmt::format("{}: found patches smaller than 1e-9 of the room, expected larger "
                      "faces or fewer divisions",
                      room_.faces[face].where));
    mesh_.patches.push_back({corners, at, eval_bilinear(at, 0.5, 0.5), normalize(twice),
                             length(twice) / 2, mesh_.vertices[corners[0]].material, object_,
                             face});
  }

  const Room& room_;
  const MeshParams& params_;
  Mesh mesh_;
  Welder welder_;
  Edges creases_;
  std::uint32_t object_ = 0;
};

}  // namespace

Mesh make_mesh(const Room& room, const MeshParams& params) { return Builder(room, params).build(); }

}  // namespace radiosity
