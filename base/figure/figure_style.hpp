#pragma once
// Size and font of a drawing.
#include <string>

namespace base {

constexpr double POINTS_PER_MM = 72 / 25.4;

/// CSS for SVG drawings of class "drawing". If the browser uses a dark theme, it inverts the
/// lightness of the drawing and keeps the hues.
constexpr auto DARK_MODE =
    "<style>@media screen and (prefers-color-scheme: dark) "
    "{ .drawing { filter: invert(0.914) hue-rotate(180deg); } }</style>";

/// A drawing for the screen has its own size, a white background and a title. A figure for a paper
/// has exactly the given width, a transparent background and no title, because the paper has a
/// caption.
struct FigureStyle {
  double width_mm = 0;  ///< width of a figure; 0: a drawing for the screen
  std::string font = "sans-serif";
  double font_pt = 8;  ///< font size of figures, in points of 1/72 inch

  bool is_figure() const { return width_mm > 0; }
  double width_pt() const { return width_mm * POINTS_PER_MM; }
};

}  // namespace base
