#include "experiments/laboratory/report/embed.hpp"

#include <fmt/format.h>

#include <boost/algorithm/string/replace.hpp>
#include <boost/archive/iterators/base64_from_binary.hpp>
#include <boost/archive/iterators/transform_width.hpp>
#include <stdexcept>

namespace laboratory {
namespace {

// Removes every element <name>...</name>. Elements of this name must not be nested.
void remove_elements(std::string& text, const std::string& name) {
  const std::string opening = "<" + name + ">", closing = "</" + name + ">";
  for (auto at = text.find(opening); at != std::string::npos; at = text.find(opening, at)) {
    const auto end = text.find(closing, at);
    if (end == std::string::npos) return;
    text.erase(at, end + closing.size() - at);
  }
}

unsigned read_big_endian(std::string_view bytes) {
  unsigned value = 0;
  for (const char c : bytes) value = value << 8 | static_cast<unsigned char>(c);
  return value;
}

}  // namespace

std::string to_base64(std::string_view bytes) {
  namespace iterators = boost::archive::iterators;
  using Digits =
      iterators::base64_from_binary<iterators::transform_width<std::string_view::iterator, 6, 8>>;
  std::string text(Digits(bytes.begin()), Digits(bytes.end()));
  text.resize((bytes.size() + 2) / 3 * 4, '=');
  return text;
}

std::string to_data_uri(std::string_view type, std::string_view bytes) {
  return fmt::format("data:{};base64,{}", type, to_base64(bytes));
}

ImageSize read_png_size(std::string_view bytes, const std::string& name) {
  using namespace std::string_view_literals;
  if (bytes.size() < 24 || !bytes.starts_with("\x89PNG\r\n\x1a\n"sv) ||
      bytes.substr(12, 4) != "IHDR")
    throw std::invalid_argument(
        fmt::format("{}: {} bytes that are no PNG image, expected one", name, bytes.size()));
  return {read_big_endian(bytes.substr(16, 4)), read_big_endian(bytes.substr(20, 4))};
}

ImageSize read_webp_size(std::string_view bytes, const std::string& name) {
  const auto kind = bytes.size() < 30 ? "" : bytes.substr(8, 8);
  const auto read = [&](std::size_t at, int count) {  // reads a little-endian number
    unsigned number = 0;
    for (int i = count; i-- > 0;)
      number = number << 8u | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
    return number;
  };
  // WebP stores each size minus 1: in 24 bits in an animation, in 14 bits in a lossless still
  // image.
  if (kind == "WEBPVP8X") return {1 + read(24, 3), 1 + read(27, 3)};
  if (kind == "WEBPVP8L") {
    const auto sizes = read(21, 4);
    return {1 + (sizes & 0x3fffu), 1 + (sizes >> 14u & 0x3fffu)};
  }
  throw std::invalid_argument(
      fmt::format("{}: {} bytes that are no lossless WebP, expected one", name, bytes.size()));
}

std::string inline_svg(std::string_view svg, const std::string& prefix,
                       const std::string& caption) {
  constexpr std::string_view OPENING = "<svg", CLOSING = "</svg>";
  const auto start = svg.find(OPENING), end = svg.rfind(CLOSING);
  if (start == std::string_view::npos || end == std::string_view::npos || end < start)
    throw std::invalid_argument(
        fmt::format("the drawing \"{}\": no <svg> element in its file", caption));
  const auto inner = start + OPENING.size();
  std::string text(svg.substr(inner, end + CLOSING.size() - inner));
  remove_elements(text, "title");  // a browser would show these titles as tool tips
  remove_elements(text, "desc");
  for (const std::string quote : {"'", "\""}) {
    boost::replace_all(text, " id=" + quote, " id=" + quote + prefix);
    boost::replace_all(text, "href=" + quote + "#", "href=" + quote + "#" + prefix);
  }
  boost::replace_all(text, "url(#", "url(#" + prefix);
  return text;
}

}  // namespace laboratory
