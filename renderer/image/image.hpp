#pragma once
// Images in fixed point. Integer addition is associative, so contributions may arrive in any order
// and the image is the same to the last bit.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// Three colour sums for each pixel, in units of 2^-32 of full intensity. Each contribution is
/// rounded to the nearest unit and clamped to -MAX_CONTRIBUTION..MAX_CONTRIBUTION; NaN counts as 0.
/// Sums of fewer than 2^21 contributions are exact; sums of more may wrap.
struct Samples {
  static constexpr double ONE = 4294967296.0;  ///< units of full intensity, 2^32
  static constexpr double MAX_CONTRIBUTION = 1024;

  struct Sums {
    std::int64_t r = 0, g = 0, b = 0;
    bool operator==(const Sums&) const = default;
  };

  int width = 0, height = 0;
  std::vector<Sums> sums;  ///< colour sums of each pixel, at y * width + x

  Samples() = default;
  Samples(int w, int h)
      : width(w), height(h), sums(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  bool operator==(const Samples&) const = default;
  void add(std::uint32_t sample, const Rgb& contribution);
  /// Adds the sums of a rectangle, which lies inside the image and has its upper left pixel at (x,
  /// y).
  void add(int x, int y, const Samples& rectangle);
  /// Adds the sums of another image of the same size.
  Samples& operator+=(const Samples& other);
  Rgb get(std::uint32_t sample) const;
};

/// Adds a contribution to the sums of one pixel, as Samples::add does.
void add(Samples::Sums& sums, const Rgb& contribution);
/// Adds two sums of the same pixel. They wrap like unsigned integers.
void add(Samples::Sums& sums, const Samples::Sums& others);
/// The colour that the sums represent.
Rgb to_rgb(const Samples::Sums& sums);

/// A picture with 8 bits per component, as in PNGs and on displays.
struct Bitmap {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb8;  ///< rows from the top, 3 bytes per pixel
  bool operator==(const Bitmap&) const = default;
};

/// Throws BadInput with the prefix `who` for a bitmap with no pixels or the wrong number of bytes.
void check(const Bitmap& bitmap, std::string_view who);

Bitmap make_bitmap(const Samples& samples);

/// Largest number of pixels in a picture file.
inline constexpr std::int64_t MAX_PICTURE = std::int64_t{1} << 24;
/// Loads a PNG of any kind (grey, palette, 16 bits, alpha) as displayed on a white background.
/// Returns exactly the bytes that save_png() wrote. Throws BadInput with the file's name if it
/// cannot be read, is not a complete PNG or has more than MAX_PICTURE pixels.
Bitmap load_png(const std::string& path);

/// Converts to rows from the top, 3 bytes per pixel. Maps 0..1 to 0..255, rounded and clamped.
std::vector<std::uint8_t> make_rgb8(const Samples& samples);
/// Converts one pixel, or a colour, in the same way.
std::array<std::uint8_t, 3> make_rgb8(const Samples& samples, std::uint32_t sample);
std::array<std::uint8_t, 3> make_rgb8(const Rgb& colour);

/// Writes an 8-bit RGB PNG as base::save_whole does, with the same errors. The bytes depend only on
/// the samples. Throws BadInput for an image without pixels.
void save_png(const std::string& path, const Samples& samples);
/// Writes bytes in the order of make_rgb8(). Throws BadInput unless there are 3 * width * height of
/// them.
void save_png(const std::string& path, int width, int height,
              const std::vector<std::uint8_t>& rgb8);

}  // namespace renderer
