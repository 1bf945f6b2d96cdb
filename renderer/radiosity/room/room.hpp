#pragma once
// What radiosity works on: flat faces that emit and reflect diffusely, and mirrors (thesis, 1.2.2).

#include <string>

#include "base/errors.hpp"
#include "renderer/scene/scene.hpp"

namespace radiosity {

using base::BadInput;
using renderer::Rgb;
using renderer::Vec;

struct Material {
  std::string name;
  Rgb reflectance;      ///< of a diffuse surface: rho of Eq 1.8, 0 <= rho < 1; of a mirror, 0..1
  Rgb emission;         ///< E of Eq 1.8, >= 0; a mirror emits nothing
  bool mirror = false;  ///< purely specular (3.2)
  bool operator==(const Material&) const = default;
};

/// A convex flat polygon of 3 corners or more, which run counter-clockwise as seen from its front.
/// Light leaves and reaches its front only; it blocks both ways.
struct Face {
  std::vector<Vec> corners;
  std::vector<Vec> normals;    ///< one a corner where it stands for a curved surface; else none
  std::uint32_t material = 0;  ///< index into Room::materials
  bool two_sided = false;      ///< its back is a second face
  int along = 1, across = 1;   ///< patches along its first edge and across it, before
                               ///< MeshParams::refine. Of other than 4 corners: each of the
                               ///< quads between a corner and the centre, along x along
  std::string where;           ///< "room.txt:12", for errors; may be empty
};

/// A straight border of a penumbra, to be kept by the mesh: across it the illumination is
/// continuous, its slope is not (3.1.4.2).
struct Crease {
  Vec a, b;
};

struct Room {
  std::vector<Material> materials;
  std::vector<Face> faces;
  std::vector<Crease> creases;
  std::vector<std::string> libraries;  ///< paths of other files that it was read from
  renderer::View view;
};

/// Throws BadInput, "where: found ..., expected ...": corners that are not finite, off the plane by
/// more than 1e-6 of the face's size, or not convex; no area; colours out of range; an emitting
/// mirror; a room without emitter or without a face that is no mirror; an impossible view.
void check(const Room& room);

/// Newell's: of the polygon's front, its length twice the area.
Vec eval_area_normal(std::span<const Vec> corners);

}  // namespace radiosity
