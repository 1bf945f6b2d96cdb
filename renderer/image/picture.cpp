#include "renderer/image/picture.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>

#include <algorithm>
#include <limits>

#include "base/whole_file.hpp"
#include "renderer/scene/require.hpp"

namespace renderer {

namespace {

constexpr const char* CHANNELS[] = {"R", "G", "B"};

std::vector<float> make_floats(const Picture& picture) {
  constexpr double MOST = std::numeric_limits<float>::max();
  std::vector<float> floats;
  floats.reserve(3 * picture.pixels.size());
  for (const Rgb& pixel : picture.pixels)
    for (const double value : {pixel.r, pixel.g, pixel.b})
      floats.push_back(static_cast<float>(std::clamp(value, -MOST, MOST)));
  return floats;
}

// Describes where in memory the channels R, G and B of rows of `width` pixels are. `first` is the
// address of the pixel at (0, 0).
Imf::FrameBuffer make_frame(float* first, std::size_t width) {
  constexpr std::size_t PIXEL = 3 * sizeof(float);
  Imf::FrameBuffer frame;
  for (const char* name : CHANNELS)
    frame.insert(name,
                 Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(first++), PIXEL, PIXEL * width));
  return frame;
}

std::string make_exr(const Picture& picture) {
  std::vector<float> floats = make_floats(picture);
  Imf::Header header(picture.width, picture.height);
  header.compression() = Imf::NO_COMPRESSION;
  for (const char* name : CHANNELS) header.channels().insert(name, Imf::Channel(Imf::FLOAT));
  Imf::StdOSStream bytes;  // written to memory first, because the destination may be a pipe
  {
    Imf::OutputFile file(bytes, header);
    file.setFrameBuffer(make_frame(floats.data(), static_cast<std::size_t>(picture.width)));
    file.writePixels(picture.height);
  }
  return bytes.str();
}

// Reads the data window of a file. Pixels of the display window outside of it do not count.
Picture read_exr(const std::string& path, Imf::InputFile& file) {
  const auto& header = file.header();
  for (const char* name : CHANNELS)
    require(header.channels().findChannel(name) != nullptr, path,
            fmt::format("no channel {}", name), "the channels R, G and B");
  const auto& window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                     height = std::int64_t{window.max.y} - window.min.y + 1;
  require(width > 0 && height > 0 && width <= MAX_PICTURE / height, path,
          fmt::format("{} x {} pixels", width, height), fmt::format("1 to {} pixels", MAX_PICTURE));
  std::vector<float> floats(static_cast<std::size_t>(3 * width * height));
  // The library computes addresses from the coordinates in the file, which may not begin at 0.
  const std::int64_t offset = 3 * (window.min.y * width + window.min.x);
  const auto first = reinterpret_cast<std::uintptr_t>(floats.data()) -
                     static_cast<std::uintptr_t>(offset) * sizeof(float);
  file.setFrameBuffer(make_frame(reinterpret_cast<float*>(first), static_cast<std::size_t>(width)));
  file.readPixels(window.min.y, window.max.y);
  Picture picture{static_cast<int>(width), static_cast<int>(height), {}};
  for (std::size_t i = 0; i < floats.size(); i += 3)
    picture.pixels.push_back({floats[i], floats[i + 1], floats[i + 2]});
  require(std::ranges::all_of(floats, [](float value) { return std::isfinite(value); }), path,
          "a value that is infinite or not a number", "finite values");
  return picture;
}

}  // namespace

Picture make_picture(const Samples& samples) {
  Picture picture{samples.width, samples.height, {}};
  picture.pixels.reserve(samples.sums.size());
  for (const auto& sums : samples.sums) picture.pixels.push_back(to_rgb(sums));
  return picture;
}

Picture make_picture(const Bitmap& bitmap) {
  Picture picture{bitmap.width, bitmap.height, {}};
  for (std::size_t i = 0; i < bitmap.rgb8.size(); i += 3)
    picture.pixels.push_back(
        {bitmap.rgb8[i] / 255.0, bitmap.rgb8[i + 1] / 255.0, bitmap.rgb8[i + 2] / 255.0});
  return picture;
}

Picture make_difference(const Picture& a, const Picture& b, double factor) {
  require(
      a.width == b.width && a.height == b.height,
      fmt::format("pictures of {} x {} and {} x {} pixels", a.width, a.height, b.width, b.height),
      "equal sizes");
  Picture difference{a.width, a.height, {}};
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const Rgb &p = a.pixels[i], &q = b.pixels[i];
    difference.pixels.push_back(factor *
                                Rgb{std::abs(p.r - q.r), std::abs(p.g - q.g), std::abs(p.b - q.b)});
  }
  return difference;
}

void save_exr(const std::string& path, const Picture& picture) {
  require(!picture.pixels.empty(), "save_exr", "a picture without pixels", "1 or more");
  base::save_whole(path, make_exr(picture));
}

Picture load_exr(const std::string& path) {
  constexpr std::size_t MAX_BYTES = 64 * static_cast<std::size_t>(MAX_PICTURE);
  const std::string bytes = base::read_text(path, MAX_BYTES);
  try {
    Imf::StdISStream stream;
    stream.str(bytes);
    Imf::InputFile file(stream);
    return read_exr(path, file);
  } catch (const base::BadInput&) {
    throw;
  } catch (const std::exception& error) {  // Iex::BaseExc and std::bad_alloc
    base::refuse(path,
                 "found a file that is not a complete OpenEXR picture ({}), expected a picture",
                 error.what());
  }
}

}  // namespace renderer
