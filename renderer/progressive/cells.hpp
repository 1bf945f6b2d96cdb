#pragma once
// Cells of the image (thesis, 4.2.2): rectangles with samples at their four corners. On a border
// with smaller cells there are further samples.

#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/trace/params.hpp"

namespace renderer::progressive {

/// A cell from the pixel (x0, y0) to the pixel (x1, y1), both included. Neighbouring cells share
/// the pixels of their border.
struct Cell {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
  bool operator==(const Cell&) const = default;
};

/// The larger side of a cell in pixels, measured between corners and rounded up to a power of two.
/// A cell of size 1 consists only of its corners.
int get_size(const Cell& cell);

/// Divides the image into cells with sides of `side` pixels between corners, row by row. The last
/// cells of a row or column may be smaller.
std::vector<Cell> make_cells(int width, int height, int side);
/// Divides a cell into 4 cells of half its size, or into 2 if only one of its sides can be halved.
std::vector<Cell> divide(const Cell& cell);
/// True if a pixel of the cell lies in the area.
bool meets(const Cell& cell, const Area& area);

/// The samples taken so far, one for each sampled pixel.
struct Sampled {
  Samples samples;
  std::vector<std::uint16_t> levels;  ///< by pixel: levels of its shading tree; 0 if not sampled

  Sampled() = default;
  Sampled(int width, int height) : samples(width, height), levels(samples.sums.size()) {}
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(samples.width) +
           static_cast<std::size_t>(x);
  }
  bool has(int x, int y) const { return levels[index(x, y)] > 0; }
  Rgb get(int x, int y) const { return samples.get(static_cast<std::uint32_t>(index(x, y))); }
};

/// The smallest and the greatest value of each colour component.
struct Range {
  Rgb least, greatest;
};
/// Extends the range so that it includes the colour.
Range widen(const Range& range, const Rgb& colour);
/// The range of the colours of all samples on the border of a cell.
Range find_range(const Cell& cell, const Sampled& sampled);

/// The contrast (max - min) / (max + min) of thesis Eq 4.7; 0 if both values are 0.
double eval_contrast(double least, double greatest);
/// The largest contrast of the three colour components.
double eval_contrast(const Range& range);

/// Computes the unsampled pixels of a cell and writes them into `picture`. On the border, they are
/// linear between neighbouring samples. Inside, they follow a bilinear Coons patch over the four
/// sides. Results are clamped to the range of the samples. Neighbouring cells compute equal values
/// on their common border.
void interpolate(const Cell& cell, const Sampled& sampled, Samples& picture);

}  // namespace renderer::progressive
