#pragma once
// Picture quality: similarity of two pictures, and visibility of the cells in an interpolated
// picture.

#include "renderer/image/picture.hpp"

namespace renderer {

/// Root mean square difference over all colour components, in grey levels from 0 to 255. Throws
/// BadInput unless the pictures have equal sizes and at least one pixel.
double rmse(const Bitmap& a, const Bitmap& b);

/// Root mean square difference of colours that have not been rounded, with components clamped to
/// 0..1. Throws BadInput as rmse() does.
double rms_difference(const Samples& a, const Samples& b);

/// Difference of two pictures over all colour components.
struct PictureDifference {
  double rms = 0;            ///< root mean square difference
  std::uint64_t pixels = 0;  ///< number of pixels that differ
  double largest = 0;        ///< largest absolute difference; the members below describe the first
  int x = 0, y = 0;          ///< its pixel, from the upper left corner
  const char* component = "red";  ///< its component: red, green or blue
  double a = 0, b = 0;            ///< its two values
};

/// Finds the difference of two pictures with linear colours, which are not clamped. Throws BadInput
/// as rmse() does.
PictureDifference find_difference(const Picture& a, const Picture& b);

/// Structural similarity (Z. Wang et al., IEEE Transactions on Image Processing 13(4), 2004). The
/// result is from -1 to 1, and is 1 only for equal pictures; swapping the pictures does not change
/// it. It is the mean over windows of 8 x 8 pixels at all positions. In smaller pictures, windows
/// are as large as the picture. Luminance is 0.299 R + 0.587 G + 0.114 B, K1 = 0.01, K2 = 0.03 and
/// L = 255. All pixels of a window have equal weight. Throws BadInput as rmse() does.
double ssim(const Bitmap& a, const Bitmap& b);

/// Smallest side in pixels of a cell for border_energy(): three pixels in a row must fit inside a
/// cell.
inline constexpr int MIN_BORDERED_CELL = 3;

/// Visibility of the borders of a grid of square cells (mosaic effect and Mach bands). The cells
/// have sides of `side` pixels, from the upper left corner of the picture.
///
/// The result is a ratio of means of squared second differences of luminance along rows and
/// columns. Differences across cell borders are in the numerator, differences inside cells in the
/// denominator. The variance of rounding, 0.5 squared grey levels, is added to both. The value 1
/// means that borders look like the rest. It is also returned for flat pictures, for pictures
/// without borders, and for pictures without three pixels in a row. Throws BadInput for a side less
/// than MIN_BORDERED_CELL and for a picture without pixels.
double border_energy(const Bitmap& picture, int side);

}  // namespace renderer
