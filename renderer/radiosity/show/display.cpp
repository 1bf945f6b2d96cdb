#include "renderer/radiosity/show/display.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>

#include <algorithm>

#include "base/whole_file.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/require.hpp"

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
  Imf::StdOSStream bytes;  // written to memory first, because the destination may be a pipe
  {
    Imf::OutputFile file(bytes, header);
    file.setFrameBuffer(pixels);
    file.writePixels(picture.height);
  }
  return bytes.str();
}

}  // namespace

base::Fields<Display> display_fields() {
  using D = base::Declare<Display>;
  return {D::number("exposure", &Display::exposure, 0, 1e9, "",
                    "a pixel is 255 * min(1, exposure * radiosity) ^ (1 / gamma); 0: chosen so "
                    "that 1 % of the non-emitting pixels are white (in the reference, if any)"),
          D::number("gamma", &Display::gamma, 0.1, 10, "", "gamma in the formula of exposure")};
}

double find_exposure(const Picture& picture, const std::vector<bool>& left_out, double share) {
  std::vector<double> all, kept;
  for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
    all.push_back(max_component(picture.pixels[i]));
    if (left_out.empty() || !left_out[i]) kept.push_back(all.back());
  }
  std::vector<double>& values = kept.empty() ? all : kept;
  if (values.empty()) return 1;
  std::ranges::sort(values);
  const double last = std::ceil(share * static_cast<double>(values.size())) - 1;
  const auto rank =
      static_cast<std::size_t>(std::clamp(last, 0.0, static_cast<double>(values.size() - 1)));
  const double white = values[rank] > 0 ? values[rank] : values.back();
  return white > 0 ? 1 / white : 1;
}

Display fit(Display display, const Picture& picture, const std::vector<bool>& left_out) {
  if (display.exposure == 0) display.exposure = find_exposure(picture, left_out);
  return display;
}

Picture make_difference(const Picture& a, const Picture& b, double factor) {
  renderer::require(
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

std::vector<std::uint8_t> make_rgb8(const Picture& picture, const Display& display) {
  const auto to_byte = [&](double value) -> std::uint8_t {
    const double light = display.exposure * value;
    if (light >= 1) return 255;
    if (!(light > 0)) return 0;
    return static_cast<std::uint8_t>(std::lround(255 * std::pow(light, 1 / display.gamma)));
  };
  std::vector<std::uint8_t> bytes;
  bytes.reserve(3 * picture.pixels.size());
  for (const Rgb& pixel : picture.pixels)
    for (const double value : {pixel.r, pixel.g, pixel.b}) bytes.push_back(to_byte(value));
  return bytes;
}

void save_png(const std::string& path, const Picture& picture, const Display& display) {
  const auto check = [](double value, const char* name) {
    renderer::require(value > 0 && std::isfinite(value), name, value, "a number above 0");
  };
  check(display.exposure, "exposure");
  check(display.gamma, "gamma");
  renderer::save_png(path, picture.width, picture.height, make_rgb8(picture, display));
}

void save_exr(const std::string& path, const Picture& picture) {
  renderer::require(!picture.pixels.empty(), "save_exr", "a picture without pixels", "1 or more");
  base::save_whole(path, make_exr(picture));
}

}  // namespace radiosity
