#include "topologies/draw/sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/text.hpp"

namespace topologies {
namespace {

constexpr double MARGIN = 4;            // points around a drawing
constexpr double LETTER = 0.62;         // mean width of a letter for a font size of 1
constexpr double LEAST_READABLE = 3.5;  // font size in points
constexpr std::size_t LONGEST_NAME = 7;

// The smallest distance between two processors, in units of the layout; 1 for a single one.
double find_closest(Places places) {
  std::ranges::sort(places, {}, &Place::x);
  double closest = INFINITY;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t k = i + 1; k < places.size() && places[k].x - places[i].x < closest; ++k)
      closest = std::min(closest, std::hypot(places[k].x - places[i].x, places[k].y - places[i].y));
  return std::isfinite(closest) ? closest : 1;
}

// The diameter that a processor needs to hold a name of `letters` letters, per point of font size.
double eval_room(std::size_t letters) {
  return std::hypot(LETTER * static_cast<double>(std::max<std::size_t>(letters, 2)), 0.8) + 0.45;
}

std::size_t count_letters(const std::string& text) {
  return static_cast<std::size_t>(
      std::ranges::count_if(text, [](unsigned char c) { return (c & 0xc0) != 0x80; }));
}

// Replaces the end of a text that has more than `most` letters by "…".
std::string shorten(const std::string& text, std::size_t most) {
  if (count_letters(text) <= most) return text;
  std::size_t end = 0;
  for (std::size_t letters = 1; letters < most; ++letters)
    end += std::max<std::size_t>(1, base::measure_utf8(std::string_view(text).substr(end)));
  return text.substr(0, end) + "…";
}

}  // namespace

Measures choose_measures(const Places& places, std::size_t letters, double outside,
                         const base::FigureStyle& style) {
  Measures m;
  if (!style.is_figure()) return m;
  constexpr double LARGEST_UNIT = 1.8;  // in diameters of a processor
  constexpr std::size_t LONGEST = 4;    // longest name, in letters, for which processors grow
  const double closest = find_closest(places);
  const auto [left, right] = std::ranges::minmax(places, {}, &Place::x);
  m.processor = style.font_pt * eval_room(std::min(letters, LONGEST));
  const double room = style.width_pt() - std::max(m.processor + 6, outside) - 2 * MARGIN;
  m.unit = std::min(room / std::max(right.x - left.x, 1e-9), LARGEST_UNIT * m.processor);
  m.processor = std::min(m.processor, 0.62 * closest * m.unit);
  m.font = style.font_pt;
  m.port = std::min(0.75 * style.font_pt, 0.3 * closest * m.unit);
  return m;
}

FittedName fit_name(const Measures& measures, const std::string& name) {
  const auto text = shorten(base::blank_controls(name), LONGEST_NAME);
  const double fits = measures.processor / eval_room(count_letters(text));
  if (fits < LEAST_READABLE) return {"", 0};
  return {text, std::min(measures.font, fits)};
}

double Sheet::width_of(const std::string& words, double size) {
  return LETTER * size * static_cast<double>(count_letters(words));
}

void Sheet::include(const Place& middle, double width, double height) {
  low_ = {std::min(low_.x, middle.x - width / 2), std::min(low_.y, middle.y - height / 2)};
  high_ = {std::max(high_.x, middle.x + width / 2), std::max(high_.y, middle.y + height / 2)};
}

void Sheet::curve(const std::array<Place, 4>& points, const std::string& colour, double width) {
  const auto [a, b, c, d] = points;
  const auto p = [&](const Place& place) {
    const auto at = to_points(place);
    return fmt::format("{:.2f},{:.2f}", at.x, at.y);
  };
  for (const double t : {0.0, 0.25, 0.5, 0.75, 1.0})
    include(to_points(eval_curve(points, t)), width, width);
  text_ += fmt::format(
      "<path fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" d=\"M{}C{} {} {}\"/>\n", colour,
      width, p(a), p(b), p(c), p(d));
}

void Sheet::arrow(std::array<Place, 4> points, const std::string& colour, double width) {
  const double length = 4 * width / unit_;  // of the head
  const auto tip = points[3];
  const double x = tip.x - points[2].x, y = tip.y - points[2].y, scale = length / std::hypot(x, y);
  const Place foot{tip.x - scale * x, tip.y - scale * y};
  const auto at = [&](double share) {
    const auto corner = to_points({foot.x - share * scale * y, foot.y + share * scale * x});
    return fmt::format("{:.2f},{:.2f}", corner.x, corner.y);
  };
  const auto end = to_points(tip);
  points[3] = foot;
  curve(points, colour, width);
  include(end, width, width);
  text_ += fmt::format("<path fill=\"{}\" d=\"M{:.2f},{:.2f}L{} {}Z\"/>\n", colour, end.x, end.y,
                       at(0.5), at(-0.5));
}

void Sheet::circle(const Place& middle, double diameter, const std::string& fill, double line,
                   const std::string& colour) {
  include(middle, diameter + line, diameter + line);
  text_ += fmt::format(
      "<circle fill=\"{}\" stroke=\"{}\" stroke-width=\"{:.2f}\" cx=\"{:.2f}\" cy=\"{:.2f}\" "
      "r=\"{:.2f}\"/>\n",
      fill, colour, line, middle.x, middle.y, diameter / 2);
}

void Sheet::box(const Place& middle, double width, double height, const std::string& fill,
                double line) {
  include(middle, width + line, height + line);
  text_ += fmt::format(
      "<rect fill=\"{}\" stroke=\"{}\" stroke-width=\"{:.2f}\" x=\"{:.2f}\" y=\"{:.2f}\" "
      "width=\"{:.2f}\" height=\"{:.2f}\"/>\n",
      fill, line > 0 ? "#000000" : "none", line, middle.x - width / 2, middle.y - height / 2, width,
      height);
}

void Sheet::text(const Place& middle, const std::string& words, const Lettering& lettering) {
  // From the middle of letters down to their baseline, for a font size of 1.
  constexpr double BASELINE = 0.36;
  const auto& [size, colour, has_halo, is_left] = lettering;
  const double width = width_of(words, size);
  include({middle.x + (is_left ? width / 2 : 0), middle.y}, width, size);
  const auto halo = has_halo ? fmt::format(
                                   " stroke=\"#ffffff\" stroke-width=\"{:.2f}\" "
                                   "stroke-linejoin=\"round\" paint-order=\"stroke\"",
                                   0.3 * size)
                             : "";
  text_ += fmt::format(
      "<text text-anchor=\"{}\" x=\"{:.2f}\" y=\"{:.2f}\" font-size=\"{:.2f}\" fill=\"{}\"{}>"
      "{}</text>\n",
      is_left ? "start" : "middle", middle.x, middle.y + BASELINE * size, size, colour, halo,
      base::escape_xml(base::blank_controls(words)));
}

void Sheet::open(const std::string& of_class, const std::string& tip) {
  text_ += fmt::format("<g class=\"{}\">", of_class);
  // The tool tip is the attribute xlink:title, because some browsers would show an element <title>
  // as the tool tip of the whole drawing.
  if (!tip.empty())
    text_ += fmt::format("<a xlink:title=\"{}\">", base::escape_xml(base::blank_controls(tip)));
  closing_ = tip.empty() ? "</g>\n" : "</a></g>\n";
}

void Sheet::close() { text_ += closing_; }

std::string Sheet::finish(const std::string& title) const {
  const double height = high_.y - low_.y + 2 * MARGIN, used = high_.x - low_.x + 2 * MARGIN;
  const double width = style_.is_figure() ? style_.width_pt() : used;
  const double left = (low_.x + high_.x - width) / 2, top = low_.y - MARGIN;
  const auto size =
      style_.is_figure()
          ? fmt::format("width=\"{:.6g}mm\" height=\"{:.2f}pt\"", style_.width_mm, height)
          : fmt::format("width=\"{:.2f}pt\" height=\"{:.2f}pt\"", width, height);
  auto svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" "
      "{} viewBox=\"{:.2f} {:.2f} {:.2f} {:.2f}\" font-family=\"{}\" class=\"drawing\">\n"
      "<title>{}</title>\n",
      size, left, top, width, height, base::escape_xml(style_.font),
      base::escape_xml(base::blank_controls(title)));
  // A figure is for paper and needs neither a background nor colours for dark mode.
  if (!style_.is_figure())
    svg += fmt::format(
        "{}\n<rect class=\"paper\" fill=\"#ffffff\" x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" "
        "height=\"{:.2f}\"/>\n",
        base::DARK_MODE, left, top, width, height);
  return svg + text_ + "</svg>\n";
}

}  // namespace topologies
