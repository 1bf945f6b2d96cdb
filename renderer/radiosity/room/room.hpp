#pragma once
// Input of radiosity: flat faces that emit and reflect diffusely, and mirrors (thesis, 1.2.2).

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
  Rgb reflectance;      ///< rho of Eq 1.8, 0 <= rho < 1; for a mirror 0..1
  Rgb emission;         ///< E of Eq 1.8, >= 0; 0 for a mirror
  bool mirror = false;  ///< purely specular, a mirror (3.2)
  bool operator==(const Material&) const = default;
};

/// Positions of the lines between patches, increasing from 0 to 1: along a face's first edge, and
/// along its next edge.
struct Grid {
  std::vector<double> along, across;
};

/// A convex flat polygon of 3 corners or more, counter-clockwise as seen from its front. Only its
/// front emits and receives light. It blocks light from both sides.
struct Face {
  std::vector<Vec> corners;
  /// one normal per corner of a face that is part of a curved surface, else empty
  std::vector<Vec> normals;
  std::uint32_t material = 0;  ///< material of the face in Room::materials
  bool two_sided = false;      ///< true if the back is a second face
  /// Number of patches along the first edge and across it, before MeshParams::refine. A face
  /// without 4 corners has `along` x `along` patches in each of the quads between a corner and the
  /// centre.
  int along = 1, across = 1;
  Grid grid;          ///< lines of a face with 4 corners; if empty, the lines are evenly spaced
  std::string where;  ///< position for errors, "room.txt:12"; may be empty
};

/// A straight line that becomes an edge of patches. At the border of a penumbra the illumination is
/// continuous, but not its slope (3.1.4.2). At a line within a penumbra, the curvature of the
/// illumination is discontinuous.
struct Crease {
  Vec a, b;
};

struct Room {
  std::vector<Material> materials;
  std::vector<Face> faces;
  std::vector<Crease> creases;
  bool fine_near_lights = false;  ///< makes make_mesh() halve patches near lights
  bool fine_shadows = false;      ///< limits steps in penumbrae (see Mesh::most_at_once)
  renderer::View view;
};

/// The bounds of all faces.
inline renderer::Bounds eval_bounds(const Room& room) {
  renderer::Bounds bounds;
  for (const Face& face : room.faces) bounds = join(bounds, renderer::make_bounds(face.corners));
  return bounds;
}

}  // namespace radiosity
