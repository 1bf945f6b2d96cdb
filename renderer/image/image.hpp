#pragma once
// Images in fixed point. Integer addition is associative, so that contributions may be added in any
// order: the image is the same to the last bit.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// An image with three colour sums for each pixel. The unit is 2^-32 of full intensity. Each
/// contribution is rounded to the nearest unit and clamped to -MAX_CONTRIBUTION..MAX_CONTRIBUTION.
/// NaN counts as 0. Sums of fewer than 2^21 contributions are exact; larger sums may wrap around.
struct Samples {
  static constexpr double ONE = 4294967296.0;  ///< full intensity, in units
  static constexpr double MAX_CONTRIBUTION = 1024;

  struct Sums {
    std::int64_t r = 0, g = 0, b = 0;
    bool operator==(const Sums&) const = default;
  };

  int width = 0, height = 0;
  std::vector<Sums> sums;  ///< sums of each pixel, at y * width + x

  Samples() = default;
  Samples(int w, int h)
      : width(w), height(h), sums(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  bool operator==(const Samples&) const = default;
  void add(std::uint32_t sample, const Rgb& contribution);
  /// Adds the sums of a rectangle of pixels, which must lie inside the image. Its upper left pixel
  /// is at (x, y).
  void add(int x, int y, const Samples& rectangle);
  /// Adds the sums of another image of equal size.
  Samples& operator+=(const Samples& other);
  Rgb get(std::uint32_t sample) const;
};

/// Adds a contribution to the sums of one pixel, as Samples::add does.
void add(Samples::Sums& sums, const Rgb& contribution);
/// Adds two sums of one pixel. Overflow wraps around, as with unsigned integers.
void add(Samples::Sums& sums, const Samples::Sums& others);
/// Converts sums to a colour, with 1 for full intensity.
Rgb to_rgb(const Samples::Sums& sums);

/// A picture with 8 bits per colour component, as in PNG files and on displays.
struct Bitmap {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb8;  ///< rows from the top; 3 bytes per pixel
  bool operator==(const Bitmap&) const = default;
};

/// Throws BadInput if a bitmap has no pixels or the wrong number of bytes. `who` is the start of
/// the message.
void check(const Bitmap& bitmap, std::string_view who);

Bitmap make_bitmap(const Samples& samples);

/// Largest number of pixels in a picture file that load_png() accepts.
inline constexpr std::int64_t MAX_PICTURE = std::int64_t{1} << 24;
/// Loads a PNG of any kind (grey, palette, 16 bits, alpha) as it would look on a white background.
/// For files of save_png(), returns the saved bytes exactly. Throws BadInput with the file's name
/// if the file cannot be read, is not a complete PNG or has more than MAX_PICTURE pixels.
Bitmap load_png(const std::string& path);

/// Converts the image to bytes: rows from the top, 3 bytes per pixel. Maps 0..1 to 0..255, rounded
/// and clamped.
std::vector<std::uint8_t> make_rgb8(const Samples& samples);
/// Converts one pixel of the image, or one colour, in the same way as make_rgb8 above.
std::array<std::uint8_t, 3> make_rgb8(const Samples& samples, std::uint32_t sample);
std::array<std::uint8_t, 3> make_rgb8(const Rgb& colour);

/// Writes an 8-bit RGB PNG. The bytes depend only on the samples. Throws BadInput for an image
/// without pixels, and the errors of base::save_whole.
void save_png(const std::string& path, const Samples& samples);
/// Writes a PNG from bytes in the order of make_rgb8(). Throws BadInput unless `rgb8` has 3 * width
/// * height bytes.
void save_png(const std::string& path, int width, int height,
              const std::vector<std::uint8_t>& rgb8);

}  // namespace renderer
