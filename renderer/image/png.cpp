// save_png(): the only place that speaks to libpng.

#include <fmt/format.h>
#include <png.h>

#include <cerrno>
#include <stdexcept>

#include "base/whole_file.hpp"
#include "renderer/image/image.hpp"

namespace renderer {

void save_png(const std::string& path, int width, int height,
              const std::vector<std::uint8_t>& rgb8) {
  if (rgb8.empty())
    throw std::invalid_argument("save_png: found an image of no pixels, expected 1 or more");
  if (rgb8.size() != std::size_t{3} * static_cast<unsigned>(width) * static_cast<unsigned>(height))
    throw std::invalid_argument(
        fmt::format("save_png: found {} bytes, expected 3 for each of {} "
                    "x {} pixels",
                    rgb8.size(), width, height));
  base::save_whole(path, [&](std::FILE* file) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = PNG_FORMAT_RGB;
    if (png_image_write_to_stdio(&image, file, 0, rgb8.data(), 0, nullptr) != 0) return 0;
    return errno != 0 ? errno : EIO;
  });
}

void save_png(const std::string& path, const Samples& samples) {
  save_png(path, samples.width, samples.height, make_rgb8(samples));
}

}  // namespace renderer
