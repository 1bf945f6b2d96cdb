#pragma once
// Attributes of SVG elements: colours, lengths, transformations and inherited properties.
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "topologies/files/xml.hpp"

namespace laboratory {

using SvgColour = std::array<double, 3>;  ///< red, green and blue, 0 to 1

/// Inherited properties of an element. Lengths are in user units.
struct SvgStyle {
  std::optional<SvgColour> fill = SvgColour{0, 0, 0}, stroke = {};  ///< none: not painted
  SvgColour colour = {0, 0, 0};                                     ///< meaning of "currentColor"
  double fill_opacity = 1, stroke_opacity = 1, stroke_width = 1, font_size = 16;
  std::vector<double> dashes = {};
  std::string font = "sans-serif", anchor = "start", cap = "butt", join = "miter";
  bool is_bold = false, is_italic = false;
};

/// The matrix (a b c d e f) of SVG: x' = a x + c y + e, y' = b x + d y + f.
using SvgMatrix = std::array<double, 6>;

/// The numbers in a text, separated by blanks, commas, letters or signs.
std::vector<double> read_numbers(std::string_view text);

/// The number of an attribute; `standard` if it is missing.
double read_number(const topologies::XmlElement& element, const char* key, double standard = 0);

/// A length in points: "85mm", "12pt", or "100" for CSS pixels of 0.75 points.
double read_length(std::string_view text);

/// A colour such as "#0072B2", "rgb(0, 114, 178)" or "black"; none for "none" and "transparent".
/// `current` is the meaning of "currentColor". Throws base::InvariantBroken for an unknown colour.
std::optional<SvgColour> read_colour(std::string_view text, const SvgColour& current);

/// The style of an element inside one with the style `outer`.
SvgStyle inherit_style(const topologies::XmlElement& element, const SvgStyle& outer);

/// The product of the transformations in an attribute: "translate(4 8) scale(2)".
SvgMatrix read_transform(std::string_view text);

}  // namespace laboratory
