#pragma once
// Topologies whose distances follow from rows and columns: meshes, tori and rings.

#include <cstdint>
#include <optional>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// Places in a row; the last is beside the first where they are closed.
struct Axis {
  int size = 1;
  bool closed = false;

  int distance(int a, int b) const;       ///< steps between two places, 0 to size - 1
  int diameter() const;                   ///< the largest of them
  std::int64_t sum_of_distances() const;  ///< over all ordered pairs of places
};

/// Processors row by row. Those beside each other in a row or a column are neighbours, no others.
struct Grid {
  Axis down, along;  ///< as many as there are rows; as many as there are columns

  int distance(int a, int b) const;  ///< links between two processors
  int diameter() const { return down.diameter() + along.diameter(); }
  std::int64_t sum_of_distances() const;  ///< over all ordered pairs of processors
};

/// The grid that a topology's links make, or none; its shape says what to look for, the links are
/// looked at. Neighbours may be on any port.
std::optional<Grid> find_grid(const Topology& topology);

/// A topology looks the same, ports included, from every processor of an orbit: the processors
/// that those of `rows` x `columns` at the grid's first corner are shifted to.
struct Orbits {
  int rows = 1, columns = 1;  ///< of the corner: one of each orbit is there
  int all_rows = 1, all_columns = 1;

  int count() const { return rows * columns; }
  /// The number of the orbit of a processor: 0 to count() - 1.
  int orbit_of(int processor) const {
    return processor / all_columns % rows * columns + processor % all_columns % columns;
  }
  /// The orbit's processor in the corner.
  int first_of(int orbit) const { return orbit / columns * all_columns + orbit % columns; }
};

/// Finds shifts along the rows and along the columns of the topology's shape which leave all links
/// and ports as they are, each processor's being those of its image. Each link is looked at. Where
/// there are none each processor is its own orbit.
Orbits find_orbits(const Topology& topology);

}  // namespace topologies
