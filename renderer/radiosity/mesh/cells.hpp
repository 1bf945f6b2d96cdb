#pragma once
// Convex cells of a flat face, cut along creases of any direction.

#include "renderer/radiosity/mesh/divide.hpp"

namespace radiosity {

/// A crease or a contact that the cells should have as edges.
struct Line {
  Crease crease;
  double touch = 0;      ///< largest distance of a point that lies on the crease
  bool contact = false;  ///< true for lines that are always cut, and precede creases
};

/// Parameters of the cells. Lengths are in the room's unit.
struct CellParams {
  double reach = 0;      ///< largest distance at which an inner point may move to a crease
  double apart = 0;      ///< least distance of a moved point from its neighbours
  std::size_t most = 0;  ///< limit on the number of cells, beyond which only contacts are cut
};

/// Cuts the quads of a division along creases, contacts first. Equal points are merged; the points
/// of the edges `fixed` do not move. Inner points move to the ends, lines and crossings of creases
/// if all cells stay well-shaped. A crease cuts all cells that it crosses by more than its `touch`.
/// If it passes a cell's corner within `touch`, the cut goes through the corner. Cuts that would
/// leave slivers are omitted.
///
/// Each cell is then divided into one quad per corner: the corner, the middles of the two adjacent
/// edges, and the cell's centre. A cell may have a straight corner where only its neighbour was
/// cut; it is first cut there. Division::left_out counts creases that did not completely become
/// edges.
Division cut_cells(const Division& division, const Vec& normal, std::span<const Edge> fixed,
                   std::span<const Line> lines, const CellParams& params);

}  // namespace radiosity
