#include "renderer/image/image.hpp"

#include <png.h>

#include "base/whole_file.hpp"
#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

std::int64_t to_fixed(double value) {
  constexpr double MAX = Samples::MAX_CONTRIBUTION * Samples::ONE;
  const double units = value * Samples::ONE;
  if (!(units == units)) return 0;
  return std::llrint(units > MAX ? MAX : units < -MAX ? -MAX : units);
}

std::uint8_t to_byte(std::int64_t sum) {
  constexpr std::int64_t ONE = std::int64_t{1} << 32;
  if (sum <= 0) return 0;
  if (sum >= ONE) return 255;
  return static_cast<std::uint8_t>((sum * 255 + ONE / 2) >> 32);
}

void check_bytes(int width, int height, const std::vector<std::uint8_t>& rgb8,
                 std::string_view who) {
  require(!rgb8.empty(), who, "an image without pixels", "1 or more");
  const auto expected =
      std::size_t{3} * static_cast<unsigned>(width) * static_cast<unsigned>(height);
  require(rgb8.size() == expected, who, fmt::format("{} bytes", rgb8.size()),
          fmt::format("3 bytes for each of {} x {} pixels", width, height));
}

}  // namespace

void add(Samples::Sums& sums, const Samples::Sums& others) {
  using Sums = Samples::Sums;
  for (const auto colour : {&Sums::r, &Sums::g, &Sums::b})
    sums.*colour = static_cast<std::int64_t>(static_cast<std::uint64_t>(sums.*colour) +
                                             static_cast<std::uint64_t>(others.*colour));
}

void add(Samples::Sums& sums, const Rgb& contribution) {
  add(sums,
      Samples::Sums{to_fixed(contribution.r), to_fixed(contribution.g), to_fixed(contribution.b)});
}

Rgb to_rgb(const Samples::Sums& s) {
  return {static_cast<double>(s.r) / Samples::ONE, static_cast<double>(s.g) / Samples::ONE,
          static_cast<double>(s.b) / Samples::ONE};
}

void Samples::add(std::uint32_t sample, const Rgb& contribution) {
  renderer::add(sums[sample], contribution);
}

Samples& Samples::operator+=(const Samples& other) {
  for (std::size_t i = 0; i < sums.size(); ++i) renderer::add(sums[i], other.sums[i]);
  return *this;
}

void Samples::add(int x, int y, const Samples& rectangle) {
  for (int row = 0; row < rectangle.height; ++row)
    for (int column = 0; column < rectangle.width; ++column)
      renderer::add(sums[static_cast<std::size_t>((y + row) * width + x + column)],
                    rectangle.sums[static_cast<std::size_t>(row * rectangle.width + column)]);
}

Rgb Samples::get(std::uint32_t sample) const { return to_rgb(sums[sample]); }

void check(const Bitmap& bitmap, std::string_view who) {
  check_bytes(bitmap.width, bitmap.height, bitmap.rgb8, who);
}

Bitmap make_bitmap(const Samples& samples) {
  return {samples.width, samples.height, make_rgb8(samples)};
}

Bitmap load_png(const std::string& path) {
  constexpr std::size_t MAX_BYTES = 16 * static_cast<std::size_t>(MAX_PICTURE);
  const std::string bytes = base::read_text(path, MAX_BYTES);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  const auto check_read = [&](int done) {
    if (done == 0) png_image_free(&image);
    require(done != 0, path, "a file that is not a complete PNG picture", "a picture");
  };
  check_read(png_image_begin_read_from_memory(&image, bytes.data(), bytes.size()));
  const auto pixels = std::uint64_t{image.width} * image.height;
  if (pixels > std::uint64_t{MAX_PICTURE}) png_image_free(&image);
  require(pixels <= std::uint64_t{MAX_PICTURE}, path,
          fmt::format("{} x {} pixels", image.width, image.height),
          fmt::format("at most {} pixels", MAX_PICTURE));
  image.format = PNG_FORMAT_RGB;
  // Without this flag, libpng would treat 16-bit samples as linear intensities instead of sRGB.
  image.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  Bitmap bitmap{static_cast<int>(image.width), static_cast<int>(image.height),
                std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
  constexpr png_color WHITE{255, 255, 255};
  check_read(png_image_finish_read(&image, &WHITE, bitmap.rgb8.data(), 0, nullptr));
  return bitmap;
}

std::vector<std::uint8_t> make_rgb8(const Samples& samples) {
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * samples.sums.size());
  for (const Samples::Sums& s : samples.sums)
    for (const std::int64_t sum : {s.r, s.g, s.b}) bytes.push_back(to_byte(sum));
  return bytes;
}

std::array<std::uint8_t, 3> make_rgb8(const Samples& samples, std::uint32_t sample) {
  const auto& s = samples.sums[sample];
  return {to_byte(s.r), to_byte(s.g), to_byte(s.b)};
}

std::array<std::uint8_t, 3> make_rgb8(const Rgb& colour) {
  return {to_byte(to_fixed(colour.r)), to_byte(to_fixed(colour.g)), to_byte(to_fixed(colour.b))};
}

void save_png(const std::string& path, int width, int height,
              const std::vector<std::uint8_t>& rgb8) {
  check_bytes(width, height, rgb8, "save_png");
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = PNG_FORMAT_RGB;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(image);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&image, bytes.data(), &size, 0, rgb8.data(), 0, nullptr) == 0)
    throw std::runtime_error(
        fmt::format("{}: cannot be written: the picture cannot be encoded as PNG", path));
  base::save_whole(path, std::string_view(bytes).substr(0, size));
}

void save_png(const std::string& path, const Samples& samples) {
  save_png(path, samples.width, samples.height, make_rgb8(samples));
}

}  // namespace renderer
