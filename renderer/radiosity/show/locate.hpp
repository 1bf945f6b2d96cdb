#pragma once
// Finds a point's patch on a face, and its position on the patch.

#include <array>

#include "renderer/radiosity/mesh/mesh.hpp"
#include "renderer/scene/work.hpp"

namespace radiosity {

/// Parameters of a point on a patch, each 0..1.
struct Spot {
  std::uint32_t patch = 0;
  double s = 0, t = 0;
};

/// Points and corners, projected along an axis from a face's plane.
using Corner = renderer::Corner;

/// Inverse bilinear interpolation: the (s, t) of a point in a convex quad with these corners, in
/// order. Points outside have values outside 0..1.
Corner invert_bilinear(const std::array<Corner, 4>& corners, const Corner& point);

/// Content of a side of one of a mesh's blockers. A grid finds a point's patch. It has as many
/// cells as patches; each cell lists the patches with bounds that touch it.
struct Side {
  enum class Kind : std::uint8_t { nothing, patches, mirror };
  Kind kind = Kind::nothing;
  std::uint32_t material = 0;  ///< of a mirror, index into Mesh::materials
  std::vector<std::uint32_t> patches;
  Corner lo, cell;  ///< the grid's corner, and the size of a cell
  int across = 0;   ///< cells along each coordinate
  std::vector<std::vector<std::uint32_t>> cells;
};
using Sides = std::vector<Side>;  ///< front and back of object 0, of object 1, ...

Sides make_sides(const Mesh& mesh);

/// The front of an object, or its back.
inline const Side& get_side(const Sides& sides, std::uint32_t object, bool back) {
  return sides[2 * object + (back ? 1 : 0)];
}

/// The patch of the side (of Kind::patches) at or nearest to a point of the object. Counts the
/// patches examined as Op::polygon_edges.
Spot locate(const Mesh& mesh, const Side& side, std::uint32_t object, const Vec& point,
            renderer::Work& work);

}  // namespace radiosity
