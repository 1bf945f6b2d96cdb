#pragma once
// Topologies whose distances follow from rows and columns: meshes, tori and rings.

#include <cstdint>
#include <optional>

#include "topologies/graph/topology.hpp"

namespace topologies {

/// A line of places, numbered from 0. If it is closed, the last place is next to the first.
struct Axis {
  int size = 1;
  bool closed = false;

  int distance(int a, int b) const;       ///< number of steps between two places
  int diameter() const;                   ///< largest number of steps between two places
  std::int64_t sum_of_distances() const;  ///< in steps, over all ordered pairs of places
};

/// A rectangle of processors, numbered row by row. Links join exactly the adjacent processors of
/// each row and column.
struct Grid {
  Axis down, along;  ///< `down.size` rows, `along.size` columns

  int distance(int a, int b) const;  ///< number of links between processors `a` and `b`
  int diameter() const { return down.diameter() + along.diameter(); }
  std::int64_t sum_of_distances() const;  ///< in links, over all ordered pairs of processors
};

/// The grid formed by a topology's links; none if they form no grid. Takes the numbers of rows and
/// columns from the topology's shape and verifies them for all links. Ports may be arbitrary.
std::optional<Grid> find_grid(const Topology& topology);

/// Orbits: classes of equivalent processors of a grid. A translation of the grid moves a processor
/// to any other processor of its orbit and preserves links and ports. The processors in the first
/// `rows` rows and `columns` columns of the grid represent all orbits.
struct Orbits {
  int rows = 1, columns = 1;          ///< size of the corner with one processor per orbit
  int all_rows = 1, all_columns = 1;  ///< number of rows and columns of the grid

  int count() const { return rows * columns; }
  /// The orbit of a processor, from 0 to count() - 1.
  int orbit_of(int processor) const {
    return processor / all_columns % rows * columns + processor % all_columns % columns;
  }
  /// The processor that represents an orbit.
  int first_of(int orbit) const { return orbit / columns * all_columns + orbit % columns; }
};

/// Finds orbits from the topology's shape. Checks for every link whether a shift by one row, or by
/// one column, preserves links and ports. If neither shift does, each processor is an orbit of its
/// own.
Orbits find_orbits(const Topology& topology);

}  // namespace topologies
