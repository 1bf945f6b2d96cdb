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

/// A lattice point: the sample of pixel (x, y), or a point beyond the image's right or lower
/// border, used only for interpolation.
struct Point {
  int x = 0, y = 0;
  bool operator==(const Point&) const = default;
};

/// From (x, y) to (x + side, y + side). It owns the pixels less than `side` from (x, y): its
/// neighbours own the right and the lower border.
struct SampledCell {
  int x = 0, y = 0;
  int side = 2;   ///< pixels, a power of two, at least 2
  int level = 0;  ///< last complete level of sampling; 0: no sample
  bool operator==(const SampledCell&) const = default;
};

constexpr int MAX_CELL_SAMPLES = 13;
using Points = boost::container::static_vector<Point, MAX_CELL_SAMPLES>;

/// The level with all samples of a cell: 3, or 2 for a side of 2, which then has a sample at each
/// of its pixels.
int last_level(const SampledCell& cell);
/// The samples that a level adds: 5, 4 and 4. With a side of 2 the second level adds 2: the other
/// two belong to neighbours, and no pixel of the cell needs them.
Points points_of_level(const SampledCell& cell, int level);
/// All samples of the cell up to its level.
Points points_of(const SampledCell& cell);
/// True if the point is a pixel of the cell.
bool owns(const SampledCell& cell, const Point& point);

/// The four daughters of a cell at its last level, with half its side: upper left, upper right,
/// lower left, lower right. Their first level is complete.
std::array<SampledCell, 4> divide(const SampledCell& cell);

/// The triangles of a cell's level: 4, 8 or 16, of equal area.
using Triangle = std::array<Point, 3>;
std::vector<Triangle> triangles_of(const SampledCell& cell);

/// A rectangle of a picture.
struct Painting {
  Area area;
  std::vector<std::uint8_t> rgb8;  ///< rows from the top, 3 bytes a pixel
};
/// The pixels of the cell within `image`, sampled or else interpolated in their triangles.
/// `colours` are those of points_of(cell). The cell's level is at least 1. Counts drawn and
/// interpolated pixels in `work`.
Painting paint(const SampledCell& cell, const Area& image, std::span<const Rgb> colours,
               Work& work);

}  // namespace renderer::progressive
