#pragma once
// Which patch of a face a point lies on, and where on it.

#include <array>

#include "renderer/radiosity/mesh/mesh.hpp"
#include "renderer/scene/work.hpp"

namespace radiosity {

/// Parameters of a point on a patch, each 0..1.
struct Spot {
  std::uint32_t patch = 0;
  double s = 0, t = 0;
};

/// Points and corners in the two coordinates that a face's plane projects to.
using Corner = renderer::Corner;

/// The (s, t) at which bilinear interpolation between the corners of a convex quad, in their order,
/// gives the point; outside 0..1 where it lies outside.
Corner invert_bilinear(const std::array<Corner, 4>& corners, const Corner& point);

/// What a side of one of a mesh's blockers is. A point's patch is found by a grid of as many cells
/// as patches, each with those that touch it by their bounds.
struct Side {
  enum class Kind : std::uint8_t { nothing, patches, mirror };
  Kind kind = Kind::nothing;
  std::uint32_t material = 0;  ///< a mirror's, index into Mesh::materials
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

/// The patch of the side (of Kind::patches) that a point of the object lies on, or next to. Counts
/// the patches looked at as Op::polygon_edges.
Spot locate(const Mesh& mesh, const Side& side, std::uint32_t object, const Vec& point,
            renderer::Work& work);

}  // namespace radiosity
