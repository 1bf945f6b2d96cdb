#pragma once
// Similarity of two pictures, and visibility of a picture's cells.

#include "renderer/image/image.hpp"

namespace renderer {

/// Root mean square of the differences over all components, in levels, 0..255. BadInput unless the
/// pictures have equal sizes and a pixel.
double rmse(const Bitmap& a, const Bitmap& b);

/// The same for colours that are not rounded to levels, with components clamped to 0..1. BadInput
/// unless the images have equal sizes and a pixel.
double rms_difference(const Samples& a, const Samples& b);

/// Structural similarity (Z. Wang et al., IEEE Transactions on Image Processing 13(4), 2004),
/// -1..1; 1 only for equal pictures; symmetric. It is the mean over all windows of 8 x 8 pixels,
/// one at every pixel where it fits; windows shrink to the size of a smaller picture. Luminance is
/// 0.299 R + 0.587 G + 0.114 B, K1 = 0.01, K2 = 0.03, L = 255, and a window's pixels have equal
/// weight. BadInput as rmse().
double ssim(const Bitmap& a, const Bitmap& b);

/// Least side of cells with an inside: three pixels in a row.
inline constexpr int MIN_BORDERED_CELL = 3;

/// Visibility of a grid of square cells of `side` pixels from the upper left: mosaic and Mach
/// bands. It is a ratio of mean squared second differences of luminance along rows and columns:
/// triples of pixels across two cells, over triples within one. The rounding variance of 0.5 levels
/// squared is added to both. 1: borders look like the rest, also in a flat picture and in one
/// without borders (or without three pixels in a row). BadInput for a side less than
/// MIN_BORDERED_CELL and a picture of no pixels.
double border_energy(const Bitmap& picture, int side);

}  // namespace renderer
