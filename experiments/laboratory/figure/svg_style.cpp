#include "experiments/laboratory/figure/svg_style.hpp"

#include <cmath>
#include <functional>
#include <map>
#include <numbers>

#include "base/errors.hpp"
#include "base/text.hpp"

namespace laboratory {
namespace {

using topologies::XmlElement;

using SvgSetters = std::map<std::string_view, void (*)(SvgStyle&, const std::string&)>;

// The value of the property `name` in the attribute `style`, else the value of the attribute
// `name`; "" if there is neither.
std::string find_property(const XmlElement& element, std::string_view name) {
  for (const auto part : base::split(element.attribute("style"), ';')) {
    const auto colon = part.find(':');
    if (colon != part.npos && base::trim(part.substr(0, colon)) == name)
      return std::string(base::trim(part.substr(colon + 1)));
  }
  return std::string(base::trim(element.attribute(name)));
}

double read_first(const std::string& text) {
  const auto numbers = read_numbers(text);
  return numbers.empty() ? 0 : numbers[0];
}

const SvgSetters& setters() {
  using Text = const std::string&;
  static const SvgSetters all = {
      {"color",
       [](SvgStyle& s, Text t) { s.colour = read_colour(t, s.colour).value_or(s.colour); }},
      {"fill", [](SvgStyle& s, Text t) { s.fill = read_colour(t, s.colour); }},
      {"stroke", [](SvgStyle& s, Text t) { s.stroke = read_colour(t, s.colour); }},
      {"fill-opacity", [](SvgStyle& s, Text t) { s.fill_opacity = read_first(t); }},
      {"stroke-opacity", [](SvgStyle& s, Text t) { s.stroke_opacity = read_first(t); }},
      {"stroke-width", [](SvgStyle& s, Text t) { s.stroke_width = read_first(t); }},
      {"stroke-dasharray", [](SvgStyle& s, Text t) { s.dashes = read_numbers(t); }},
      {"stroke-linecap", [](SvgStyle& s, Text t) { s.cap = t; }},
      {"stroke-linejoin", [](SvgStyle& s, Text t) { s.join = t; }},
      {"font-family", [](SvgStyle& s, Text t) { s.font = base::trim(t.substr(0, t.find(','))); }},
      {"font-size", [](SvgStyle& s, Text t) { s.font_size = read_first(t); }},
      {"font-weight", [](SvgStyle& s, Text t) { s.is_bold = t == "bold"; }},
      {"font-style", [](SvgStyle& s, Text t) { s.is_italic = t == "italic"; }},
      {"text-anchor", [](SvgStyle& s, Text t) { s.anchor = t; }},
  };
  return all;
}

double parse_hex(std::string_view digits) {
  int value = 0;
  const auto end = digits.data() + digits.size();
  if (std::from_chars(digits.data(), end, value, 16).ptr != end)
    throw base::InvariantBroken(fmt::format("SVG: found the colour digits {}", digits));
  return value / (digits.size() == 1 ? 15.0 : 255.0);
}

// The product of two transformations, which applies `i` first and then `o`.
SvgMatrix multiply(const SvgMatrix& o, const SvgMatrix& i) {
  return {o[0] * i[0] + o[2] * i[1],        o[1] * i[0] + o[3] * i[1],
          o[0] * i[2] + o[2] * i[3],        o[1] * i[2] + o[3] * i[3],
          o[0] * i[4] + o[2] * i[5] + o[4], o[1] * i[4] + o[3] * i[5] + o[5]};
}

SvgMatrix make_matrix(std::string_view kind, std::vector<double> n) {
  const auto count = n.size();
  n.resize(6);
  if (kind == "translate") return {1, 0, 0, 1, n[0], n[1]};
  if (kind == "scale") return {n[0], 0, 0, count > 1 ? n[1] : n[0], 0, 0};
  if (kind == "matrix") return {n[0], n[1], n[2], n[3], n[4], n[5]};
  if (kind != "rotate")
    throw base::InvariantBroken(fmt::format("SVG: found the transformation {}", kind));
  const double angle = n[0] * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  return {c, s, -s, c, n[1] - c * n[1] + s * n[2], n[2] - s * n[1] - c * n[2]};
}

}  // namespace

std::vector<double> read_numbers(std::string_view text) {
  std::vector<double> numbers;
  for (std::size_t at = 0; at < text.size();) {
    double value = 0;
    const auto start = text.data() + at + (text[at] == '+');
    const auto [stop, error] = std::from_chars(start, text.data() + text.size(), value);
    if (error == std::errc()) numbers.push_back(value);
    at = error == std::errc() ? static_cast<std::size_t>(stop - text.data()) : at + 1;
  }
  return numbers;
}

double read_number(const XmlElement& element, const char* key, double standard) {
  const auto numbers = read_numbers(element.attribute(key));
  return numbers.empty() ? standard : numbers[0];
}

double read_length(std::string_view text) {
  const double number = read_first(std::string(text));
  if (text.ends_with("pt")) return number;
  return text.ends_with("mm") ? number * 72 / 25.4 : number * 0.75;
}

std::optional<SvgColour> read_colour(std::string_view text, const SvgColour& current) {
  static const std::map<std::string_view, SvgColour> NAMES = {
      {"black", {0, 0, 0}}, {"white", {1, 1, 1}}, {"gray", {0.5, 0.5, 0.5}}, {"red", {1, 0, 0}}};
  if (text == "none" || text == "transparent") return std::nullopt;
  if (text == "currentColor") return current;
  if (text.starts_with("rgb(")) {
    auto parts = read_numbers(text);
    parts.resize(3);
    return SvgColour{parts[0] / 255, parts[1] / 255, parts[2] / 255};
  }
  if (text.starts_with('#') && (text.size() == 4 || text.size() == 7)) {
    const std::size_t digits = text.size() / 3;
    return SvgColour{parse_hex(text.substr(1, digits)), parse_hex(text.substr(1 + digits, digits)),
                     parse_hex(text.substr(1 + 2 * digits, digits))};
  }
  const auto known = NAMES.find(text);
  if (known == NAMES.end())
    throw base::InvariantBroken(fmt::format("SVG: found the colour {}", base::quote(text)));
  return known->second;
}

SvgStyle inherit_style(const XmlElement& element, const SvgStyle& outer) {
  SvgStyle style = outer;
  // "color" comes first in the map, because the colours of other properties may refer to it
  for (const auto& [name, set] : setters())
    if (const auto text = find_property(element, name); !text.empty()) set(style, text);
  return style;
}

SvgMatrix read_transform(std::string_view text) {
  SvgMatrix whole{1, 0, 0, 1, 0, 0};
  for (auto open = text.find('('); open != text.npos; open = text.find('(')) {
    const auto close = std::min(text.find(')', open), text.size());
    whole = multiply(whole, make_matrix(base::trim(text.substr(0, open)),
                                        read_numbers(text.substr(open, close - open))));
    text.remove_prefix(std::min(close + 1, text.size()));
    while (!text.empty() && (text[0] == ',' || text[0] == ' ')) text.remove_prefix(1);
  }
  return whole;
}

}  // namespace laboratory
