#pragma once
// Convex cells of a flat face, cut along creases of any direction.

#include "renderer/radiosity/mesh/divide.hpp"

namespace radiosity {

/// A crease or a contact that the cells should have as edges.
struct Line {
  Crease crease;
  double touch = 0;      ///< distance within which a point lies on the crease, in the room's unit
  bool contact = false;  ///< contacts, and other lines that are always cut, precede creases
};

/// Parameters of the cells. Lengths are in the room's unit.
struct CellParams {
  double reach = 0;      ///< distance from a crease within which inner points may move to it
  double apart = 0;      ///< least distance of moved points from their neighbours
  std::size_t most = 0;  ///< limit on the number of cells, beyond which only contacts are cut
};

/// Cuts the quads of a division along creases, contacts first. Equal points are merged; the points
/// of the edges `fixed` do not move. Inner points move to the ends, lines and crossings of creases
/// if all cells stay well-shaped. A crease cuts all cells that it crosses by more than its `touch`.
/// If it passes a cell's corner within that distance, it goes through the corner. Cuts that would
/// leave slivers are omitted.
///
/// Each cell is then divided into one quad per corner: the corner, the middles of its edges, and
/// the cell's centre. A cell whose neighbour was cut may have a straight corner, and is first cut
/// there. Division::left_out counts creases that are not completely kept.
Division cut_cells(const Division& division, const Vec& normal, std::span<const Edge> fixed,
                   std::span<const Line> lines, const CellParams& params);

}  // namespace radiosity
