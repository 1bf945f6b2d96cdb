#pragma once
// Picture quality: similarity of two pictures, and visibility of a picture's cells.

#include "renderer/image/image.hpp"

namespace renderer {

/// Root mean square difference over all components, in grey levels, 0..255. Throws BadInput unless
/// the pictures have equal sizes and at least one pixel.
double rmse(const Bitmap& a, const Bitmap& b);

/// Root mean square difference of unrounded colours, with components clamped to 0..1. Throws
/// BadInput as rmse() does.
double rms_difference(const Samples& a, const Samples& b);

/// Structural similarity (Z. Wang et al., IEEE Transactions on Image Processing 13(4), 2004),
/// -1..1; 1 only for equal pictures; symmetric. It is the mean over windows of 8 x 8 pixels at all
/// positions. A window is at most as large as the picture. Luminance is 0.299 R + 0.587 G + 0.114
/// B, K1 = 0.01, K2 = 0.03, L = 255, and the pixels of a window have equal weight. Throws BadInput
/// as rmse() does.
double ssim(const Bitmap& a, const Bitmap& b);

/// Least side of a cell for border_energy(): three pixels in a row must fit inside.
inline constexpr int MIN_BORDERED_CELL = 3;

/// Visibility of a grid of square cells of `side` pixels from the upper left: mosaic effect and
/// Mach bands. It is based on the squared second differences of luminance along rows and columns:
/// their mean across cell borders, divided by their mean inside cells. The rounding variance of 0.5
/// levels squared is added to both means. A value of 1 means that borders look like the rest. Flat
/// pictures also have the value 1, as do pictures without borders or without three pixels in a row.
/// Throws BadInput for a side less than MIN_BORDERED_CELL and for a picture without pixels.
double border_energy(const Bitmap& picture, int side);

}  // namespace renderer
