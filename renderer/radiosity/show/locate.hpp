#pragma once
// Point location: finds the patch of a point on a face, and the point's position on the patch.

#include <array>

#include "renderer/radiosity/mesh/mesh.hpp"
#include "renderer/scene/work.hpp"

namespace radiosity {

/// Parameters of a point on a patch, each 0..1.
struct Spot {
  std::uint32_t patch = 0;
  double s = 0, t = 0;
};

/// A point of a face's plane, projected along an axis.
using Corner = renderer::Corner;

/// Inverse bilinear interpolation: the (s, t) of a point in a convex quad with these corners, in
/// order. Points outside have values outside 0..1.
Corner invert_bilinear(const std::array<Corner, 4>& corners, const Corner& point);

/// The patches on one side of a blocker of a mesh, with a grid for point location. The grid has as
/// many cells as there are patches. Each cell lists the patches whose bounds touch it.
struct Side {
  enum class Kind : std::uint8_t { nothing, patches, mirror };
  Kind kind = Kind::nothing;
  std::uint32_t material = 0;  ///< for a mirror: index into Mesh::materials
  std::vector<std::uint32_t> patches;
  Corner lo, cell;  ///< corner of the grid, and size of a cell
  int across = 0;   ///< number of cells along each coordinate
  std::vector<std::vector<std::uint32_t>> cells;
};
using Sides = std::vector<Side>;  ///< front and back of object 0, of object 1, ...

Sides make_sides(const Mesh& mesh);

/// The front or back of an object.
inline const Side& get_side(const Sides& sides, std::uint32_t object, bool back) {
  return sides[2 * object + (back ? 1 : 0)];
}

/// The patch of a side (of Kind::patches) that contains a point of the object, or is nearest to it.
/// Counts the examined patches as Op::polygon_edges.
Spot locate(const Mesh& mesh, const Side& side, std::uint32_t object, const Vec& point,
            renderer::Work& work);

}  // namespace radiosity
