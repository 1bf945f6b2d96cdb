#pragma once
// Image cells with up to 13 samples (thesis, 5.2.1): squares on the lattice of pixel samples. A
// cell is sampled in three levels, and interpolated over triangles of equal area. After the last
// level it is divided into four cells. New samples of a level are N, W, E, S and o:
//
//   level 1      level 2      level 3
//   A-----B      A--N--B      A--N--B
//   |     |      |     |      | o o |
//   |  M  |      W  M  E      W  M  E
//   |     |      |     |      | o o |
//   C-----D      C--S--D      C--S--D
#include <boost/container/static_vector.hpp>
#include <span>

#include "renderer/progressive/cells.hpp"

namespace renderer::progressive {

/// A point of the lattice: the sample of pixel (x, y). A point may lie beyond the right or lower
/// border of the image; it is then used only for interpolation.
struct Point {
  int x = 0, y = 0;
  bool operator==(const Point&) const = default;
};

/// A cell from the lattice point (x, y) to (x + side, y + side). It owns the pixels less than
/// `side` to the right of x and below y. The pixels on its right and lower borders belong to
/// neighbouring cells.
struct SampledCell {
  int x = 0, y = 0;
  int side = 2;   ///< in pixels, a power of two, at least 2
  int level = 0;  ///< last level whose samples are complete; 0: no samples
  bool operator==(const SampledCell&) const = default;
};

constexpr int MAX_CELL_SAMPLES = 13;
using Points = boost::container::static_vector<Point, MAX_CELL_SAMPLES>;

/// The last level of a cell: 3, or 2 for a side of 2 pixels, since the cell then has a sample at
/// each of its pixels.
int last_level(const SampledCell& cell);
/// The samples that a level adds: 5, 4 and 4. For a side of 2 pixels, level 2 adds only 2 samples,
/// because the other two belong to neighbouring cells and no pixel of this cell needs them.
Points points_of_level(const SampledCell& cell, int level);
/// All samples of the cell, up to its current level.
Points points_of(const SampledCell& cell);
/// True if the point is a pixel that belongs to the cell.
bool owns(const SampledCell& cell, const Point& point);

/// Divides a cell at its last level into four cells of half its side: upper left, upper right,
/// lower left, lower right. Level 1 of the new cells is complete.
std::array<SampledCell, 4> divide(const SampledCell& cell);

/// The triangles for interpolation at the cell's level: 4, 8 or 16 triangles of equal area.
using Triangle = std::array<Point, 3>;
std::vector<Triangle> triangles_of(const SampledCell& cell);

/// The colours of a rectangle of a picture.
struct Painting {
  Area area;
  std::vector<std::uint8_t> rgb8;  ///< rows from the top; 3 bytes per pixel
};
/// Computes the pixels of the cell that lie in `image`, by samples or by interpolation. `colours`
/// are the colours of points_of(cell), in this order. The cell's level must be at least 1. Counts
/// drawn and interpolated pixels in `work`.
Painting paint(const SampledCell& cell, const Area& image, std::span<const Rgb> colours,
               Work& work);

}  // namespace renderer::progressive
