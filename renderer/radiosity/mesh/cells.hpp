#pragma once
// A flat face cut into convex cells along creases in any direction.

#include "renderer/radiosity/mesh/divide.hpp"

namespace radiosity {

/// Lengths in the room's units.
struct CellParams {
  double reach = 0;  ///< inner points that are nearer than this to creases may move there
  double touch = 0;  ///< points that are nearer than this to a crease's line lie on it
};

/// The quads of a division, cut along creases. Points equal each other become one; those of `fixed`
/// (edges between them) are not moved. Inner points move to the creases' ends, to the creases or to
/// where they cross each other, as long as all cells stay well-shaped. A crease cuts all cells
/// through which it runs for more than `touch`. Each cell becomes a quad for each of its corners:
/// the corner, the middles of its edges, the cell's centre. Where a neighbour is cut and the cell
/// is not, the cell has a straight corner, and is cut at this first.
Division cut_cells(const Division& division, const Vec& normal, std::span<const Edge> fixed,
                   std::span<const Crease> creases, const CellParams& params);

}  // namespace radiosity
