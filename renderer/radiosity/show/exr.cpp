// save_exr(): the only place that speaks to OpenEXR.

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>

#include <cerrno>
#include <stdexcept>

#include "base/whole_file.hpp"
#include "renderer/radiosity/show/picture.hpp"

namespace radiosity {

namespace {

std::vector<float> make_floats(const Picture& picture) {
  constexpr double MOST = std::numeric_limits<float>::max();
  std::vector<float> floats;
  floats.reserve(3 * picture.pixels.size());
  for (const Rgb& pixel : picture.pixels)
    for (const double value : {pixel.r, pixel.g, pixel.b})
      floats.push_back(static_cast<float>(std::clamp(value, -MOST, MOST)));
  return floats;
}

std::string make_exr(const Picture& picture) {
  std::vector<float> floats = make_floats(picture);
  Imf::Header header(picture.width, picture.height);
  header.compression() = Imf::NO_COMPRESSION;
  Imf::FrameBuffer pixels;
  constexpr std::size_t PIXEL = 3 * sizeof(float);
  std::size_t first = 0;
  for (const char* name : {"R", "G", "B"}) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    pixels.insert(name, Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(floats.data() + first++),
                                   PIXEL, PIXEL * static_cast<std::size_t>(picture.width)));
  }
  Imf::StdOSStream bytes;  // in memory: what is written may be a pipe
  {
    Imf::OutputFile file(bytes, header);
    file.setFrameBuffer(pixels);
    file.writePixels(picture.height);
  }
  return bytes.str();
}

}  // namespace

void save_exr(const std::string& path, const Picture& picture) {
  if (picture.pixels.empty())
    throw std::invalid_argument("save_exr: found a picture of no pixels, expected 1 or more");
  const std::string bytes = make_exr(picture);
  base::save_whole(path, [&](std::FILE* file) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), file) == bytes.size()) return 0;
    return errno != 0 ? errno : EIO;
  });
}

}  // namespace radiosity
