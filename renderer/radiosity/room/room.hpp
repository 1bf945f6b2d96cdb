#pragma once
// Input of radiosity: a room of flat faces that emit and reflect light diffusely, and of mirrors
// (thesis, 1.2.2).

#include <string>

#include "base/errors.hpp"
#include "renderer/radiosity/room/planar.hpp"
#include "renderer/scene/scene.hpp"

namespace radiosity {

using base::BadInput;
using renderer::Rgb;

inline double sum(const Rgb& colour) { return colour.r + colour.g + colour.b; }

struct Material {
  std::string name;
  Rgb reflectance;      ///< rho of thesis Eq 1.8, 0 <= rho < 1; for a mirror 0..1
  Rgb emission;         ///< E of thesis Eq 1.8, >= 0; 0 for a mirror
  bool mirror = false;  ///< purely specular (thesis, 3.2)
  bool operator==(const Material&) const = default;
};

/// Positions of the lines between a face's patches, increasing from 0 to 1: along the face's first
/// edge, and along its second edge.
struct Grid {
  std::vector<double> along, across;
};

/// A flat convex polygon of at least 3 corners, counter-clockwise as seen from its front. Only the
/// front emits and receives light. Both sides block light.
struct Face {
  std::vector<Vec> corners;
  /// One normal per corner if the face is part of a curved surface; otherwise empty.
  std::vector<Vec> normals;
  std::uint32_t material = 0;  ///< index into Room::materials
  bool two_sided = false;      ///< the back also emits and receives light
  /// Number of patches along the first edge and across it, before multiplication by
  /// MeshParams::refine. A face without 4 corners is first divided into one quad per corner; each
  /// of these quads has `along` x `along` patches.
  int along = 1, across = 1;
  Grid grid;          ///< for a face with 4 corners; if empty, lines are evenly spaced
  std::string where;  ///< position for messages, such as "room.txt:12"; may be empty
};

/// A straight line on a face that becomes an edge of patches. At the border of a penumbra, the
/// illumination is continuous, but its slope is not (thesis, 3.1.4.2). At a line within a penumbra,
/// the curvature of the illumination is discontinuous.
struct Crease {
  Vec a, b;
};

struct Room {
  std::vector<Material> materials;
  std::vector<Face> faces;
  std::vector<Crease> creases;
  bool fine_near_lights = false;  ///< make_mesh() halves patches near lights
  bool fine_shadows = false;  ///< limits the steps of light in penumbrae (see Mesh::most_at_once)
  renderer::View view;
};

/// The bounding box of all faces.
inline renderer::Bounds eval_bounds(const Room& room) {
  renderer::Bounds bounds;
  for (const Face& face : room.faces) bounds = join(bounds, renderer::make_bounds(face.corners));
  return bounds;
}

}  // namespace radiosity
