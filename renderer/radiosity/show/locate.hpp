#pragma once
// Point location: finds the patch at a point of a face, and the point's parameters in the patch.

#include <array>

#include "renderer/radiosity/mesh/mesh.hpp"
#include "renderer/scene/work.hpp"

namespace radiosity {

/// A point on a patch, given by the patch's parameters s and t, each from 0 to 1.
struct Spot {
  std::uint32_t patch = 0;
  double s = 0, t = 0;
};

/// A point in the plane of a face, projected along a coordinate axis.
using Corner = renderer::Corner;

/// Inverse bilinear interpolation: the parameters (s, t) of a point in a convex quad with the given
/// corners, in order. A point outside has a parameter outside 0..1.
Corner invert_bilinear(const std::array<Corner, 4>& corners, const Corner& point);

/// The patches on one side of an object in Mesh::blockers, with a grid for point location. The grid
/// has about as many cells as there are patches. Each cell lists the patches whose bounding boxes
/// touch it.
struct Side {
  enum class Kind : std::uint8_t { nothing, patches, mirror };
  Kind kind = Kind::nothing;
  std::uint32_t material = 0;  ///< for a mirror: index into Mesh::materials
  std::vector<std::uint32_t> patches;
  Corner lo, cell;  ///< corner of the grid with the smallest coordinates, and size of a cell
  int across = 0;   ///< number of cells along each of the two coordinates
  std::vector<std::vector<std::uint32_t>> cells;
};
using Sides = std::vector<Side>;  ///< front of object 0, its back, front of object 1, ...

Sides make_sides(const Mesh& mesh);

/// The side of an object that a ray meets: its back if `back`, otherwise its front.
inline const Side& get_side(const Sides& sides, std::uint32_t object, bool back) {
  return sides[2 * object + (back ? 1 : 0)];
}

/// The patch of a side that contains a point of the object, or is nearest to it. The side must be
/// of Kind::patches. Counts examined patches as Op::polygon_edges in `work`.
Spot locate(const Mesh& mesh, const Side& side, std::uint32_t object, const Vec& point,
            renderer::Work& work);

}  // namespace radiosity
