// Encodes files for inclusion in a self-contained page.
#pragma once

#include <string>
#include <string_view>

namespace laboratory {

/// RFC 4648.
std::string to_base64(std::string_view bytes);

/// "data:image/png;base64,..." for the type "image/png".
std::string to_data_uri(std::string_view type, std::string_view bytes);

/// In pixels.
struct ImageSize {
  unsigned width = 0, height = 0;
};

/// Reads the size from the file's header. Throws std::invalid_argument, naming `name`, for bytes
/// that are not a PNG.
ImageSize read_png_size(std::string_view bytes, const std::string& name);
/// The same for a WebP, animated or lossless.
ImageSize read_webp_size(std::string_view bytes, const std::string& name);

/// Extracts the <svg> element of a file for use inside a page: without prolog, titles and
/// descriptions, and without its first four characters, "<svg", so that the page can add
/// attributes. Puts `prefix` before every identifier and reference, so that several drawings share
/// a page. Throws std::invalid_argument, naming the drawing's `caption`, for a text without an
/// <svg> element.
std::string inline_svg(std::string_view svg, const std::string& prefix, const std::string& caption);

}  // namespace laboratory
