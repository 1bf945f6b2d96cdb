#pragma once
// How near a picture is to another one, and how much of its cells can be seen.

#include "renderer/image/image.hpp"

namespace renderer {

/// Root mean square of the differences over all components, in levels, 0..255. BadInput unless the
/// pictures have equal sizes and a pixel.
double rmse(const Bitmap& a, const Bitmap& b);

/// The same of colours that are not rounded to levels, components clamped to 0..1. BadInput unless
/// the images have equal sizes and a pixel.
double rms_difference(const Samples& a, const Samples& b);

/// Structural similarity (Z. Wang et al., IEEE Transactions on Image Processing 13(4), 2004),
/// -1..1, 1 for equal pictures only; symmetric. It is the mean over every window of 8 x 8 pixels
/// that lies in the picture (they begin at every pixel; a picture that is less wide or high has
/// windows as wide or high as it is), of luminance 0.299 R + 0.587 G + 0.114 B, with K1 = 0.01, K2
/// = 0.03, L = 255 and all pixels of a window of one weight. BadInput as rmse().
double ssim(const Bitmap& a, const Bitmap& b);

/// Least side of cells that have an inside: three pixels in a row.
inline constexpr int MIN_BORDERED_CELL = 3;

/// What can be seen of a grid of square cells of `side` pixels, the first at the upper left: mosaic
/// and Mach bands. It is the mean square of the second differences of luminance, along rows and
/// columns, of the three pixels in a row that lie in two cells, over that of those in one cell; 0.5
/// levels squared, what rounding to levels adds, is added to both. 1: borders are as the rest; 1 in
/// a flat picture as well, and in one without borders (or without three pixels in a row). BadInput
/// for a side less than MIN_BORDERED_CELL and a picture of no pixels.
double border_energy(const Bitmap& picture, int side);

}  // namespace renderer
