#pragma once
// Convex cells of a flat face, cut along creases in any direction.

#include "renderer/radiosity/mesh/divide.hpp"

namespace radiosity {

/// A crease to be kept, or a contact.
struct Line {
  Crease crease;
  double touch = 0;      ///< nearer points lie on the crease; in the room's unit
  bool contact = false;  ///< contacts, and other lines that are always cut, come before creases
};

/// Lengths in the room's units.
struct CellParams {
  double reach = 0;      ///< inner points nearer than this to creases may move there
  double apart = 0;      ///< minimum distance of moved points from their neighbours
  std::size_t most = 0;  ///< maximum number of cells, beyond which only contacts are cut
};

/// The quads of a division, cut along creases, contacts first. Equal points become one; those of
/// `fixed` (edges between them) do not move. Inner points move to the creases' ends, to the creases
/// or to their crossings, as long as all cells stay well-shaped. A crease cuts all cells that it
/// crosses for more than its touch. It passes through a cell's corner that is as near, and leaves
/// out slivers. Each cell becomes a quad for each of its corners: the corner, the middles of its
/// edges, the cell's centre. A cell with a cut neighbour may have a straight corner, and is first
/// cut there. Division::left_out counts creases that could not be kept whole.
Division cut_cells(const Division& division, const Vec& normal, std::span<const Edge> fixed,
                   std::span<const Line> lines, const CellParams& params);

}  // namespace radiosity
