#include "renderer/radiosity/show/display.hpp"

#include <algorithm>

#include "renderer/image/image.hpp"
#include "renderer/scene/require.hpp"

namespace radiosity {

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

}  // namespace radiosity
