#pragma once
// The options --exposure and --gamma of tlab render, and the picture files that it writes.
#include <string>

#include "renderer/image/image.hpp"

namespace CLI {
class App;
}

namespace laboratory {

/// Conversion of colours to bytes: 255 * min(1, 2^exposure * colour) ^ (1 / gamma), rounded.
struct ImageEncoding {
  double exposure = 0;     ///< stops
  double gamma = 1;        ///< 1: bytes are proportional to the colour
  bool is_linear = false;  ///< true: files are OpenEXR, with colours as 32-bit floats
};

/// Adds --exposure and --gamma, which set `encoding`.
void add_encoding_options(CLI::App& command, ImageEncoding& encoding);

/// Sets ImageEncoding::is_linear if the name of the output ends in .exr. Throws
/// CLI::ValidationError if `command` got --exposure or --gamma nevertheless, which do not affect
/// linear colours.
void fit_encoding(const CLI::App& command, const std::string& output, ImageEncoding& encoding);
/// Throws as fit_encoding() does, if `asked` states that --exposure or --gamma was given. Returns
/// true if the name ends in .exr.
bool check_exr(const std::string& output, bool asked);

/// The extension of files that save_image() writes: ".png" or ".exr".
const char* extension_of(const ImageEncoding& encoding);
renderer::Bitmap encode(const renderer::Samples& samples, const ImageEncoding& encoding);
/// Writes a PNG or OpenEXR file. Throws as renderer::save_png() does.
void save_image(const std::string& path, const renderer::Samples& samples,
                const ImageEncoding& encoding);

}  // namespace laboratory
