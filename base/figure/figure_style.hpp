#pragma once
// Size and font of a drawing.
#include <string>

namespace base {

constexpr double POINTS_PER_MM = 72 / 25.4;

/// Style of an SVG of class "drawing": on dark pages, its lightness is inverted and its hues stay.
constexpr auto DARK_MODE =
    "<style>@media screen and (prefers-color-scheme: dark) "
    "{ .drawing { filter: invert(0.914) hue-rotate(180deg); } }</style>";

/// A drawing for the screen has its own size, a white background and a title. A figure for a paper
/// has exactly the given width, a transparent background and no title, because the paper has a
/// caption.
struct FigureStyle {
  double width_mm = 0;  ///< 0: for the screen
  std::string font = "sans-serif";
  double font_pt = 8;  ///< font size of figures, in points of 1/72 inch

  bool is_figure() const { return width_mm > 0; }
  double width_pt() const { return width_mm * POINTS_PER_MM; }
};

}  // namespace base
