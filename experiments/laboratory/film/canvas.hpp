#pragma once
// A raster canvas drawn with Cairo. Lengths are in pixels, and y points downwards.
#include <array>
#include <memory>
#include <string>

#include "renderer/image/image.hpp"
#include "topologies/draw/layout.hpp"

namespace laboratory {

using Colour = std::array<double, 3>;  ///< red, green and blue, each from 0 to 1

inline constexpr Colour WHITE{1, 1, 1}, INK{0.13, 0.13, 0.13}, FAINT{0.42, 0.42, 0.42},
    PALE{0.86, 0.86, 0.86};

struct Rectangle {
  double x = 0, y = 0, width = 0, height = 0;  ///< x and y of the upper left corner
};

enum class Align { left, middle, right };

/// A raster image. Its pixels are the same on all hosts that have the same versions of Cairo and
/// the same fonts.
class Canvas {
 public:
  /// Makes a white canvas; sizes in pixels.
  Canvas(int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  void fill(const Rectangle& area, const Colour& colour);
  void outline(const Rectangle& area, const Colour& colour, double line = 1);
  void line(double x0, double y0, double x1, double y1, const Colour& colour, double line = 1);
  void disc(const topologies::Place& middle, double radius, const Colour& colour);
  void ring(const topologies::Place& middle, double radius, const Colour& colour, double line);
  /// Draws a cubic Bezier curve with these control points.
  void curve(const std::array<topologies::Place, 4>& points, const Colour& colour, double line);
  /// Draws a line of sans-serif text with its base line at `y`. `align` states which part of the
  /// text is at `x`: its left end, its middle or its right end. `size` is the font size in pixels.
  void text(double x, double y, const std::string& words, double size, Align align = Align::left,
            const Colour& colour = INK);
  /// Draws text with a white outline, so that it stays readable on top of lines.
  void text_on_lines(double x, double y, const std::string& words, double size, Align align);
  /// Draws a picture with its upper left corner at (x, y). Each pixel of the picture becomes a
  /// square of `factor` by `factor` pixels.
  void picture(int x, int y, const renderer::Bitmap& bitmap, int factor);

  renderer::Bitmap bitmap() const;

 private:
  struct Cairo;
  struct End {
    void operator()(Cairo* cairo) const;
  };
  void set(const Colour& colour, double line = 1);

  int width_, height_;
  std::unique_ptr<Cairo, End> cairo_;
};

/// Width of a text in pixels; `size` is the font size in pixels.
double text_width(const std::string& words, double size);
/// Shortens a text to `width` pixels by replacing its end with "…".
std::string shorten_to(const std::string& words, double size, double width);

}  // namespace laboratory
