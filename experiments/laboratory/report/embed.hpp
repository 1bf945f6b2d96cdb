// Encodes files so that a self-contained HTML page can contain them.
#pragma once

#include <string>
#include <string_view>

namespace laboratory {

/// Encodes bytes in Base64 (RFC 4648).
std::string to_base64(std::string_view bytes);

/// Makes a data URI: for the type "image/png", it begins with "data:image/png;base64,".
std::string to_data_uri(std::string_view type, std::string_view bytes);

/// Size of an image in pixels.
struct ImageSize {
  unsigned width = 0, height = 0;
};

/// Reads the size from the header of a PNG file. Throws std::invalid_argument with `name` if the
/// bytes are not a PNG file.
ImageSize read_png_size(std::string_view bytes, const std::string& name);
/// Reads the size of a WebP file. The file is an animation or a lossless still image. Throws as
/// read_png_size() does.
ImageSize read_webp_size(std::string_view bytes, const std::string& name);

/// Extracts the <svg> element of a drawing for use inside an HTML page, without prolog, titles and
/// descriptions. The result starts after "<svg", so that the page can add attributes. Puts `prefix`
/// before every identifier and every reference to one, so that several drawings can share a page.
/// Throws std::invalid_argument with the drawing's `caption` if the text has no <svg> element.
std::string inline_svg(std::string_view svg, const std::string& prefix, const std::string& caption);

}  // namespace laboratory
