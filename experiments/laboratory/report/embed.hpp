// Encoding of files for a self-contained HTML page.
#pragma once

#include <string>
#include <string_view>

namespace laboratory {

/// Base64 according to RFC 4648.
std::string to_base64(std::string_view bytes);

/// Makes a data URI, such as "data:image/png;base64,..." for the type "image/png".
std::string to_data_uri(std::string_view type, std::string_view bytes);

/// Size of an image in pixels.
struct ImageSize {
  unsigned width = 0, height = 0;
};

/// Reads the size from the header of a PNG. Throws std::invalid_argument with `name` for bytes that
/// are not a PNG.
ImageSize read_png_size(std::string_view bytes, const std::string& name);
/// Reads the size of a WebP, animated or lossless. Throws as read_png_size does.
ImageSize read_webp_size(std::string_view bytes, const std::string& name);

/// Extracts the <svg> element of a drawing for use inside an HTML page, without prolog, titles and
/// descriptions. The result starts after "<svg", so that the page can add attributes. Puts `prefix`
/// before every identifier and reference, so that several drawings can share a page. Throws
/// std::invalid_argument with the drawing's `caption` for a text without an <svg> element.
std::string inline_svg(std::string_view svg, const std::string& prefix, const std::string& caption);

}  // namespace laboratory
