#pragma once
// Cells of the image (thesis, 4.2.2): rectangles with samples at their four corners. A border to
// smaller cells has further samples.

#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/trace/params.hpp"

namespace renderer::progressive {

/// A cell from the sample at (x0, y0) to that at (x1, y1), both included. Neighbours share a
/// border.
struct Cell {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool operator==(const Cell&) const = default;
};

/// The larger side of a cell in pixel steps, rounded up to a power of two. A cell of size 1 has no
/// pixel between its corners.
int get_size(const Cell& cell);

/// Makes cells with sides of `side` steps over the image, row by row. The last ones may be smaller.
std::vector<Cell> make_cells(int width, int height, int side);
/// Divides a cell into 4 cells of half its size, or into 2 if one side cannot be halved.
std::vector<Cell> divide(const Cell& cell);
/// True if a cell has a pixel in an area.
bool meets(const Cell& cell, const Area& area);

/// The pixels that have been sampled.
struct Sampled {
  Samples samples;
  std::vector<std::uint16_t> levels;  ///< levels of each pixel's shading tree; 0: not sampled

  Sampled() = default;
  Sampled(int width, int height) : samples(width, height), levels(samples.sums.size()) {}
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(samples.width) +
           static_cast<std::size_t>(x);
  }
  bool has(int x, int y) const { return levels[index(x, y)] > 0; }
  Rgb get(int x, int y) const { return samples.get(static_cast<std::uint32_t>(index(x, y))); }
};

/// The minimum and maximum of each colour component.
struct Range {
  Rgb least, greatest;
};
/// Extends the range to include a colour.
Range widen(const Range& range, const Rgb& colour);
/// The range of all samples on the border of a cell.
Range find_range(const Cell& cell, const Sampled& sampled);

/// The contrast (max - min) / (max + min) of Eq 4.7; 0 if both are black.
double eval_contrast(double least, double greatest);
/// The largest contrast of the three components.
double eval_contrast(const Range& range);

/// Interpolates the unsampled pixels of a cell into `picture`: linearly between samples on the
/// border, and inside by a bilinear Coons patch over the four sides. The result is clamped to the
/// range of the samples. Neighbours agree on their common border.
void interpolate(const Cell& cell, const Sampled& sampled, Samples& picture);

}  // namespace renderer::progressive
