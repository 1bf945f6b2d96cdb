// save_png(): the only place that speaks to libpng.

#include <fmt/format.h>
#include <png.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "renderer/image.hpp"

namespace renderer {

namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& path, int error) {
  throw std::system_error(error != 0 ? error : EIO, std::generic_category(),
                          fmt::format("cannot write {}", path));
}

// 0 when every byte has reached the system, else the error.
int write_png(std::FILE* file, const Samples& samples) {
  const std::vector<std::uint8_t> bytes = make_rgb8(samples);
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(samples.width);
  image.height = static_cast<png_uint_32>(samples.height);
  image.format = PNG_FORMAT_RGB;
  errno = 0;
  const bool written = png_image_write_to_stdio(&image, file, 0, bytes.data(), 0, nullptr) != 0 &&
                       std::fflush(file) == 0;
  return written ? 0 : errno != 0 ? errno : EIO;
}

// Opens, writes and closes; 0 or the error.
int write_file(const std::string& path, const Samples& samples) {
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return errno;
  const int error = write_png(file, samples);
  return std::fclose(file) == 0 || error != 0 ? error : errno;
}

}  // namespace

void save_png(const std::string& path, const Samples& samples) {
  if (samples.sums.empty())
    throw std::invalid_argument("save_png: found an image of no pixels, expected 1 or more");
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  // A device or a pipe cannot be replaced: it is written in place.
  if (fs::exists(status) && !fs::is_regular_file(status)) {
    if (const int error = write_file(path, samples)) fail(path, error);
    return;
  }
  // What a link points to is replaced, not the link.
  const std::string target = fs::exists(status) ? fs::canonical(path).string() : path;
  const std::string draft = fmt::format("{}.{}.part", target, ::getpid());
  int error = write_file(draft, samples);
  if (error == 0 && std::rename(draft.c_str(), target.c_str()) != 0) error = errno;
  if (error != 0) {
    std::remove(draft.c_str());
    fail(path, error);
  }
}

}  // namespace renderer
