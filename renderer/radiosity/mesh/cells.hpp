#pragma once
// A flat face cut into convex cells along creases; a cell's border may have straight corners where
// a neighbour is cut and it is not.

#include <map>

#include "renderer/radiosity/mesh/divide.hpp"
#include "renderer/radiosity/room/planar.hpp"

namespace radiosity {

class Cells {
 public:
  /// Cells are the quads of a division; equal points become one, the others keep their order.
  Cells(const Division& division, const Vec& normal);

  /// The point will not be moved.
  void fix(std::uint32_t point) { line_[point] = FIXED; }
  /// Moves inner points that are nearer than `reach` to the creases' ends, to the creases or to
  /// where they cross each other there, as long as all cells stay well-shaped.
  void move_points(std::span<const Crease> creases, double reach);
  /// Cuts all cells through which the crease runs for more than `touch`; points nearer to its line
  /// than that are taken to lie on it.
  void cut(const Crease& crease, double touch);
  /// A quad for each corner of each cell: the corner, the middles of its edges, the cell's centre.
  /// A cell with straight corners is cut at these first. Points come first, as they are.
  Division make_quads() const;

 private:
  using Loop = std::vector<std::uint32_t>;
  struct Chord;
  static constexpr std::int32_t FREE = -1, FIXED = -2;

  bool move(std::uint32_t point, const Vec& to);
  void move_to_end(const Vec& end, double reach);
  std::optional<Chord> find_chord(std::size_t cell, std::span<const double> heights) const;
  std::uint32_t split_edge(std::uint32_t a, std::uint32_t b, double share);
  void split_edges_at(const Vec& origin, const Vec& along, double end, double touch,
                      std::vector<double>& heights);
  void own(std::size_t cell);

  Vec normal_;
  std::vector<Vec> points_;
  std::vector<std::int32_t> line_;  // the crease that a point was moved to, FREE or FIXED
  std::vector<Loop> cells_;
  std::vector<Loop> around_;  // cells around each point, before the first cut
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> owner_;  // the cell on the left
};

}  // namespace radiosity
