#include "experiments/laboratory/picture/image_encoding.hpp"

#include <cmath>
#include <filesystem>

#include "experiments/laboratory/options/options.hpp"
#include "renderer/radiosity/show/display.hpp"

namespace laboratory {

void add_encoding_options(CLI::App& command, ImageEncoding& encoding) {
  using D = base::Declare<ImageEncoding>;
  bind_options(
      command,
      {D::number("exposure", &ImageEncoding::exposure, -32, 32, "",
                 "brightness in stops, each a factor of 2, before values above white are clipped; "
                 "not for .exr"),
       D::number("gamma", &ImageEncoding::gamma, 0.1, 10, "",
                 "gamma of the PNG file: a colour of 0..1 becomes 255 * colour ^ (1 / gamma); "
                 "not for .exr")},
      encoding);
}

bool check_exr(const std::string& output, bool asked) {
  const bool is_exr = std::filesystem::path(output).extension() == ".exr";
  if (is_exr && asked)
    throw CLI::ValidationError(
        "--output", fmt::format("found \"{}\" with --exposure or --gamma, expected another kind of "
                                "file, because the colours in an .exr file are linear",
                                output));
  return is_exr;
}

void fit_encoding(const CLI::App& command, const std::string& output, ImageEncoding& encoding) {
  encoding.is_linear =
      check_exr(output, command.count("--exposure") + command.count("--gamma") > 0);
}

const char* extension_of(const ImageEncoding& encoding) {
  return encoding.is_linear ? ".exr" : ".png";
}

renderer::Bitmap encode(const renderer::Samples& samples, const ImageEncoding& encoding) {
  if (encoding.exposure == 0 && encoding.gamma == 1) return make_bitmap(samples);
  return {samples.width, samples.height,
          radiosity::make_rgb8(renderer::make_picture(samples),
                               {std::exp2(encoding.exposure), encoding.gamma})};
}

void save_image(const std::string& path, const renderer::Samples& samples,
                const ImageEncoding& encoding) {
  if (encoding.is_linear) return renderer::save_exr(path, renderer::make_picture(samples));
  renderer::save_png(path, samples.width, samples.height, encode(samples, encoding).rgb8);
}

}  // namespace laboratory
