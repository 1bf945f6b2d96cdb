#pragma once
// Topologies whose distances follow from rows and columns: meshes, tori and rings.

#include <cstdint>
#include <optional>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Places in a line; in a closed one the last is next to the first.
struct Axis {
  int size = 1;
  bool closed = false;

  int distance(int a, int b) const;       ///< steps between two places, 0 to size - 1
  int diameter() const;                   ///< the largest distance
  std::int64_t sum_of_distances() const;  ///< over all ordered pairs of places
};

/// Processors numbered row by row; exactly the adjacent ones in a row or a column are linked.
struct Grid {
  Axis down, along;  ///< `down.size` rows, `along.size` columns

  int distance(int a, int b) const;  ///< links between two processors
  int diameter() const { return down.diameter() + along.diameter(); }
  std::int64_t sum_of_distances() const;  ///< over all ordered pairs of processors
};

/// The grid that a topology's links form, or none. The shape gives the size to try; the links are
/// verified. Neighbours may be on any port.
std::optional<Grid> find_grid(const Topology& topology);

/// Orbits under translation: the wiring, ports included, looks the same from every processor of an
/// orbit. The `rows` x `columns` processors at the grid's first corner represent all orbits.
struct Orbits {
  int rows = 1, columns = 1;          ///< size of the corner, with one processor of each orbit
  int all_rows = 1, all_columns = 1;  ///< size of the grid

  int count() const { return rows * columns; }
  /// The orbit of a processor, 0 to count() - 1.
  int orbit_of(int processor) const {
    return processor / all_columns % rows * columns + processor % all_columns % columns;
  }
  /// The orbit's processor in the corner.
  int first_of(int orbit) const { return orbit / columns * all_columns + orbit % columns; }
};

/// Tests whether shifts by one row, and by one column, of the topology's shape preserve all links
/// and ports; checks every link. Without such a shift, each processor is its own orbit.
Orbits find_orbits(const Topology& topology);

}  // namespace topologies
