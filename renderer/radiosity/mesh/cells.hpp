#pragma once
// Convex cells of a flat face, made by cutting the face along creases of any direction.

#include "renderer/radiosity/mesh/divide.hpp"

namespace radiosity {

/// A line along which the cells should have edges: a crease, or a contact with another face.
struct Line {
  Crease crease;
  double touch = 0;      ///< points up to this distance from the line lie on it
  bool contact = false;  ///< true for a contact; contacts are always cut, and come before creases
};

/// Parameters of the cells. Lengths are in the room's unit.
struct CellParams {
  double reach = 0;      ///< an inner point nearer than this to a crease may move onto it
  double apart = 0;      ///< smallest distance of a moved point from its neighbours
  std::size_t most = 0;  ///< from this number of cells on, only contacts are cut
};

/// Cuts the quads of a division along lines, contacts first. Merges equal points. Points of the
/// edges `fixed` do not move. Inner points move to the ends, lines and crossings of creases if all
/// cells stay well-shaped. A crease cuts all cells that it crosses over more than its `touch`. If
/// it passes a cell's corner within `touch`, the cut goes through the corner. A cut that would
/// leave a very narrow part is omitted.
///
/// Then divides each cell into one quad per corner. Its points are the corner, the middles of the
/// two adjacent edges, and the centre of the cell. A cell may have a straight corner where only its
/// neighbour was cut; such a cell is first cut at this corner. Division::left_out counts the
/// creases that did not completely become edges.
Division cut_cells(const Division& division, const Vec& normal, std::span<const Edge> fixed,
                   std::span<const Line> lines, const CellParams& params);

}  // namespace radiosity
