// From radiosity to bytes.

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "renderer/image/image.hpp"
#include "renderer/radiosity/show/picture.hpp"

namespace radiosity {

double find_exposure(const Picture& picture, double share) {
  if (picture.pixels.empty()) return 1;
  std::vector<double> values;
  for (const Rgb& pixel : picture.pixels) values.push_back(max_component(pixel));
  std::ranges::sort(values);
  const double last = std::ceil(share * static_cast<double>(values.size())) - 1;
  const auto rank =
      static_cast<std::size_t>(std::clamp(last, 0.0, static_cast<double>(values.size() - 1)));
  const double white = values[rank] > 0 ? values[rank] : values.back();
  return white > 0 ? 1 / white : 1;
}

Picture make_difference(const Picture& a, const Picture& b, double factor) {
  if (a.width != b.width || a.height != b.height)
    throw std::invalid_argument(
        fmt::format("found pictures of {} x {} and {} x {} pixels, "
                    "expected equal sizes",
                    a.width, a.height, b.width, b.height));
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
  const auto require = [](double value, const char* name) {
    if (!(value > 0 && std::isfinite(value)))
      throw std::invalid_argument(
          fmt::format("{}: found {}, expected a number above 0", name, value));
  };
  require(display.exposure, "exposure");
  require(display.gamma, "gamma");
  renderer::save_png(path, picture.width, picture.height, make_rgb8(picture, display));
}

}  // namespace radiosity
