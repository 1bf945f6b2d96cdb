#pragma once
// A sheet on which a topology is drawn, written as SVG.
#include <array>
#include <string>

#include "base/figure/figure_style.hpp"
#include "topologies/draw/layout.hpp"

namespace topologies {

/// Lengths of a drawing in points.
struct Measures {
  double unit = 36;       ///< one unit of the layout
  double processor = 27;  ///< diameter of a processor
  double font = 11;       ///< font size of names
  double port = 8;        ///< font size of port numbers
};

/// Chooses the measures. On the screen they are the defaults. The unit of a figure follows from its
/// width; if there is no room for names of `letters` letters at the style's font size, the names
/// are smaller. `outside` is the width in points that the drawing needs beside the processors.
Measures choose_measures(const Places& places, std::size_t letters, double outside,
                         const base::FigureStyle& style);

/// A name as a processor shows it.
struct FittedName {
  std::string text;
  double size;  ///< font size in points
};

/// Fits a name into a processor: chooses the font size, and shortens long names. The text is ""
/// if it would be unreadable.
FittedName fit_name(const Measures& measures, const std::string& name);

/// Attributes of a text.
struct Lettering {
  double size;
  std::string colour = "#000000";
  bool has_halo = false;  ///< true for a white outline that keeps the text readable on lines
  bool is_left = false;   ///< true for a text that begins at its place; otherwise it is centred
};

/// Collects the elements of an SVG, in points. The y axis points upwards in layouts, and downwards
/// in the SVG.
class Sheet {
 public:
  Sheet(base::FigureStyle style, double unit) : style_(std::move(style)), unit_(unit) {}

  const base::FigureStyle& style() const { return style_; }
  /// Converts a place of the layout to points.
  Place to_points(const Place& place) const { return {unit_ * place.x, -unit_ * place.y}; }
  /// The estimated width of a text in points.
  static double width_of(const std::string& words, double size);

  /// Draws a Bezier curve with control points of the layout.
  void curve(const std::array<Place, 4>& points, const std::string& colour, double width);
  /// Draws such a curve with a head at its end.
  void arrow(std::array<Place, 4> points, const std::string& colour, double width);
  void circle(const Place& middle, double diameter, const std::string& fill, double line,
              const std::string& colour = "#000000");
  void box(const Place& middle, double width, double height, const std::string& fill, double line);
  /// Draws a text whose letters have their middle at `middle`.
  void text(const Place& middle, const std::string& words, const Lettering& lettering);
  /// Opens a group with the class `of_class` for all elements until close(). `tip` is the group's
  /// tool tip; "" means none.
  void open(const std::string& of_class, const std::string& tip);
  void close();
  /// Reserves room for an area around a point.
  void include(const Place& middle, double width, double height);

  Place low() const { return low_; }    ///< upper left corner of the used area
  Place high() const { return high_; }  ///< lower right corner

  /// Returns the SVG, with a margin. A figure is centred within its width.
  std::string finish(const std::string& title) const;

 private:
  base::FigureStyle style_;
  double unit_;
  std::string text_, closing_;
  Place low_{1e9, 1e9}, high_{-1e9, -1e9};
};

}  // namespace topologies
