#include "experiments/laboratory/compare/compare_images.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/errors.hpp"
#include "renderer/radiosity/show/display.hpp"

namespace laboratory {
namespace {

bool is_exr(const std::string& path) { return path.ends_with(".exr"); }

renderer::Picture load_image(const std::string& path) {
  return is_exr(path) ? renderer::load_exr(path) : renderer::make_picture(renderer::load_png(path));
}

renderer::Bitmap show(const renderer::Picture& picture, const radiosity::Display& display) {
  return {picture.width, picture.height, radiosity::make_rgb8(picture, display)};
}

}  // namespace

bool is_image(const std::string& path) {
  return (path.ends_with(".png") || is_exr(path)) && !std::filesystem::is_directory(path);
}

ImagePair compare_images(const std::string& reference, const std::string& other) {
  ImagePair pair{{reference, other}, is_exr(reference), {}, {}, 1};
  base::require(is_exr(other) == pair.is_linear, other,
                "found another kind of picture than {}, expected two .png or two .exr files",
                reference);
  auto& [a, b] = pair.pictures;
  a = load_image(reference), b = load_image(other);
  base::require(a.width == b.width && a.height == b.height, other,
                "found {} x {} pixels, expected {} x {} as in {}", b.width, b.height, a.width,
                a.height, reference);
  pair.difference = renderer::find_difference(a, b);
  const auto display = pair.is_linear ? radiosity::Display{radiosity::find_exposure(a), 2.2}
                                      : radiosity::Display{1, 1};
  pair.ssim = renderer::ssim(show(a, display), show(b, display));
  return pair;
}

std::string to_text(const ImagePair& pair) {
  const auto& d = pair.difference;
  const auto& a = pair.pictures[0];
  const double scale = pair.is_linear ? 1 : 255;
  const char* unit = pair.is_linear ? "" : " grey levels";
  const auto pixels = a.pixels.size();
  auto text = fmt::format(
      "{} and {}: {} x {} pixels\n  RMSE                {:.6g}{}\n  SSIM                {:.6g}\n",
      pair.names[0], pair.names[1], a.width, a.height, scale * d.rms, unit, pair.ssim);
  if (d.pixels > 0)
    text += fmt::format("  largest difference  {:.6g}{}: {} at x = {}, y = {}, {:.6g} and {:.6g}\n",
                        scale * d.largest, unit, d.component, d.x, d.y, scale * d.a, scale * d.b);
  return text + fmt::format("  different pixels    {} of {}, {:.2f} %\n", d.pixels, pixels,
                            100 * static_cast<double>(d.pixels) / static_cast<double>(pixels));
}

double save_difference(const std::string& path, const ImagePair& pair) {
  const auto& [a, b] = pair.pictures;
  const bool is_scaled = !is_exr(path) && pair.difference.largest > 0;
  const double factor = is_scaled ? 1 / pair.difference.largest : 1;
  const auto difference = renderer::make_difference(a, b, factor);
  if (is_exr(path))
    renderer::save_exr(path, difference);
  else
    radiosity::save_png(path, difference, {1, 1});
  return factor;
}

}  // namespace laboratory
