#include "experiments/laboratory/film/frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulator/observe/ticks.hpp"

namespace laboratory {

namespace {

// height of the time axis and font sizes, pixels
constexpr double BAR = 10, SMALL = 11, LARGE = 13, TITLE = 15;
constexpr double TICK_WIDTH = 70;  // maximum width of a tick mark's label, pixels
constexpr Colour PAST{0.55, 0.67, 0.82}, PRESENT{0.11, 0.29, 0.53};

struct Unit {
  double s;
  const char* name;
};

// The largest of the units s, ms and µs that is not longer than the length; ns for shorter lengths.
Unit choose_unit(double length_s) {
  for (const Unit unit : {Unit{1, "s"}, Unit{1e-3, "ms"}, Unit{1e-6, "µs"}})
    if (length_s >= unit.s) return unit;
  return {1e-9, "ns"};
}

}  // namespace

std::string format_time(double time_s, double whole_s) {
  const auto [unit_s, name] = choose_unit(whole_s);
  const double finest = std::max(whole_s / unit_s / 100, 1e-9);
  const int digits = std::max(0, static_cast<int>(std::ceil(-std::log10(finest))));
  return fmt::format("{:.{}f} {}", time_s / unit_s, digits, name);
}

void draw_title(Canvas& canvas, const std::string& title) {
  canvas.text(FRAME_MARGIN, 26, shorten_to(title, TITLE, canvas.width() - 2 * FRAME_MARGIN), TITLE);
}

void draw_time_scale(Canvas& canvas, const Span& film, const Span& now) {
  const double top = canvas.height() - TIME_SCALE_HEIGHT, width = canvas.width() - 2 * FRAME_MARGIN;
  const double length_s = std::max(film.length_s(), 1e-9);
  const auto at = [&](double time_s) {
    return FRAME_MARGIN + width * std::clamp((time_s - film.from_s) / length_s, 0.0, 1.0);
  };
  canvas.text(FRAME_MARGIN, top + 12, "simulated time " + format_time(now.to_s, length_s), LARGE);
  const double y = top + 22;
  canvas.fill({FRAME_MARGIN, y, width, BAR}, PALE);
  canvas.fill({FRAME_MARGIN, y, at(now.to_s) - FRAME_MARGIN, BAR}, PAST);
  const double from = std::max<double>(FRAME_MARGIN, std::min(at(now.from_s), at(now.to_s) - 2));
  canvas.fill({from, y, at(now.to_s) - from, BAR}, PRESENT);
  canvas.line(at(now.to_s), y - 3, at(now.to_s), y + BAR + 3, PRESENT, 2);

  const auto step_ns = observe::choose_ticks(length_s, std::max(2.0, width / TICK_WIDTH)).step_ns;
  const double step_s = static_cast<double>(step_ns) * 1e-9;
  const auto [unit_s, unit] = choose_unit(length_s);
  for (auto mark = static_cast<std::int64_t>(std::ceil(film.from_s / step_s - 1e-9));
       static_cast<double>(mark) * step_s <= film.to_s + 1e-9 * step_s; ++mark) {
    const double x = at(static_cast<double>(mark) * step_s);
    const auto words = fmt::format("{:g} {}", static_cast<double>(mark) * step_s / unit_s, unit);
    const double half = text_width(words, SMALL) / 2;
    canvas.line(x, y + BAR, x, y + BAR + 4, FAINT);
    canvas.text(std::clamp(x, half + 2, canvas.width() - half - 2), y + BAR + 16, words, SMALL,
                Align::middle, FAINT);
  }
}

}  // namespace laboratory
