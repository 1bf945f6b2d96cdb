#pragma once
// Image cells with up to 13 samples (thesis, 5.2.1): squares on the lattice of pixel samples. They
// are sampled in levels, interpolated in triangles of equal area, and divided into four.
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

/// A lattice point: the sample of pixel (x, y), or a point beyond the image's right or lower border
/// that is used only for interpolation.
struct Point {
  int x = 0, y = 0;
  bool operator==(const Point&) const = default;
};

/// A cell from (x, y) to (x + side, y + side). It owns the pixels less than `side` from (x, y);
/// neighbours own the right and lower borders.
struct SampledCell {
  int x = 0, y = 0;
  int side = 2;   ///< side in pixels, a power of two, at least 2
  int level = 0;  ///< last complete level of sampling; 0: no samples
  bool operator==(const SampledCell&) const = default;
};

constexpr int MAX_CELL_SAMPLES = 13;
using Points = boost::container::static_vector<Point, MAX_CELL_SAMPLES>;

/// The level at which a cell has all its samples: 3, or 2 for a side of 2, which then has a sample
/// at each pixel.
int last_level(const SampledCell& cell);
/// The samples that a level adds: 5, 4 and 4. With a side of 2, the second level adds only 2. The
/// other two would belong to neighbours, and no pixel of the cell needs them.
Points points_of_level(const SampledCell& cell, int level);
/// All samples of the cell up to its level.
Points points_of(const SampledCell& cell);
/// True if the cell owns the pixel of the point.
bool owns(const SampledCell& cell, const Point& point);

/// Divides a cell at its last level into four cells of half its side: upper left, upper right,
/// lower left, lower right. Their first level is complete.
std::array<SampledCell, 4> divide(const SampledCell& cell);

/// The triangles for interpolation at the cell's level: 4, 8 or 16, of equal area.
using Triangle = std::array<Point, 3>;
std::vector<Triangle> triangles_of(const SampledCell& cell);

/// A painted rectangle of a picture.
struct Painting {
  Area area;
  std::vector<std::uint8_t> rgb8;  ///< rows from the top, 3 bytes per pixel
};
/// Paints the pixels of the cell that lie in `image`, sampled or interpolated. `colours` are those
/// of points_of(cell). The cell's level must be at least 1. Counts drawn and interpolated pixels in
/// `work`.
Painting paint(const SampledCell& cell, const Area& image, std::span<const Rgb> colours,
               Work& work);

}  // namespace renderer::progressive
