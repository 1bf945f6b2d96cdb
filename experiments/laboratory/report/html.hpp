// What a page needs that holds everything it shows.
#pragma once

#include <string>
#include <string_view>

namespace laboratory {

/// Text as HTML, for elements and quoted attributes alike.
std::string escape_html(std::string_view text);

std::string to_base64(std::string_view bytes);

/// "data:image/png;base64,..." for the type "image/png".
std::string to_data_uri(std::string_view type, std::string_view bytes);

struct PngSize {
  unsigned width = 0, height = 0;
};

/// From the file's header. std::invalid_argument, naming `name`, for bytes that are no PNG.
PngSize read_png_size(std::string_view bytes, const std::string& name);

/// An SVG file as an element inside a page: without prolog and comments of its program, with
/// `label` for readers who cannot see it, and with `prefix` before every identifier and every
/// reference to one, so that several drawings share a page. std::invalid_argument, naming `label`,
/// for a text without an <svg> element.
std::string inline_svg(std::string_view svg, const std::string& prefix, const std::string& label);

}  // namespace laboratory
