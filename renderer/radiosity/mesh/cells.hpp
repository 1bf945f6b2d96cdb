#pragma once
// A flat face cut into convex cells along creases in any direction.

#include "renderer/radiosity/mesh/divide.hpp"

namespace radiosity {

/// A crease to be kept, or a contact.
struct Line {
  Crease crease;
  double touch = 0;      ///< points that are nearer than this to it lie on it; in the room's unit
  bool contact = false;  ///< contacts, and lines that are cut as they are, come before creases
};

/// Lengths in the room's units.
struct CellParams {
  double reach = 0;      ///< inner points that are nearer than this to creases may move there
  double apart = 0;      ///< points do not move nearer to their neighbours than this
  std::size_t most = 0;  ///< cells; no crease but contacts is cut where there are as many
};

/// The quads of a division, cut along creases, contacts first. Points equal each other become one;
/// those of `fixed` (edges between them) are not moved. Inner points move to the creases' ends, to
/// the creases or to where they cross each other, as long as all cells stay well-shaped. A crease
/// cuts all cells through which it runs for more than its touch; where a corner of the cell is as
/// near, there, and not if that made a sliver. Each cell becomes a quad for each of its corners:
/// the corner, the middles of its edges, the cell's centre. Where a neighbour is cut and the cell
/// is not, the cell has a straight corner, and is cut at this first. Creases that could not be kept
/// whole are counted in Division::left_out.
Division cut_cells(const Division& division, const Vec& normal, std::span<const Edge> fixed,
                   std::span<const Line> lines, const CellParams& params);

}  // namespace radiosity
