#pragma once
// Samples in fixed point: integer addition is associative, so contributions may arrive in any
// order and from anywhere, and the image is the same to the last bit.

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/scene/vec.hpp"

namespace renderer {

/// Three sums for each pixel, in units of 2^-32 of full intensity. A single contribution is rounded
/// to the nearest unit and clamped to -MAX_CONTRIBUTION..MAX_CONTRIBUTION (NaN counts as 0);
/// sums are exact below 2^21 contributions of that size, and wrap beyond.
struct Samples {
  static constexpr double ONE = 4294967296.0;  ///< 2^32
  static constexpr double MAX_CONTRIBUTION = 1024;

  struct Sums {
    std::int64_t r = 0, g = 0, b = 0;
    bool operator==(const Sums&) const = default;
  };

  int width = 0, height = 0;
  std::vector<Sums> sums;  ///< at y * width + x

  Samples() = default;
  Samples(int w, int h)
      : width(w), height(h), sums(static_cast<std::size_t>(w) * static_cast<std::size_t>(h)) {}

  bool operator==(const Samples&) const = default;
  void add(std::uint32_t sample, const Rgb& contribution);
  /// Adds the sums of a rectangle within the image; its upper left pixel is (x, y).
  void add(int x, int y, const Samples& rectangle);
  /// Adds other contributions to the same image; sizes must be equal.
  Samples& operator+=(const Samples& other);
  Rgb get(std::uint32_t sample) const;
};

/// Adds a contribution to the sums of one sample, as Samples::add.
void add(Samples::Sums& sums, const Rgb& contribution);
/// Adds other contributions to the same sample; wraps as unsigned integers do.
void add(Samples::Sums& sums, const Samples::Sums& others);
/// The colour that sums stand for.
Rgb to_rgb(const Samples::Sums& sums);

/// A picture as PNGs have it and displays show it.
struct Bitmap {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb8;  ///< rows from the top, 3 bytes a pixel
  bool operator==(const Bitmap&) const = default;
};

/// BadInput, beginning with `who`, for no pixels or another number of bytes than they need.
void check(const Bitmap& bitmap, std::string_view who);

Bitmap make_bitmap(const Samples& samples);

/// Most pixels of a picture that is read.
inline constexpr std::int64_t MAX_PICTURE = std::int64_t{1} << 24;
/// Reads a PNG of any kind (grey, palette, 16 bits, alpha) as a display shows it, on white where it
/// is transparent: the bytes of one that save_png() wrote. BadInput naming the file if it cannot be
/// read, is no whole PNG or has more than MAX_PICTURE pixels.
Bitmap load_png(const std::string& path);

/// Rows from the top, 3 bytes a pixel: 0..1 becomes 0..255, rounded; what is outside is clamped.
std::vector<std::uint8_t> make_rgb8(const Samples& samples);
/// One of its pixels, and a colour, in the same way.
std::array<std::uint8_t, 3> make_rgb8(const Samples& samples, std::uint32_t sample);
std::array<std::uint8_t, 3> make_rgb8(const Rgb& colour);

/// Writes an 8-bit RGB PNG as base::save_whole does, with its errors. The bytes depend on the
/// samples only (no date, no text). BadInput for an image of no pixels.
void save_png(const std::string& path, const Samples& samples);
/// Writes bytes in the order of make_rgb8(); BadInput unless there are 3 * width * height.
void save_png(const std::string& path, int width, int height,
              const std::vector<std::uint8_t>& rgb8);

}  // namespace renderer
