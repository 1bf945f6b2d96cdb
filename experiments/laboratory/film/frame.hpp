#pragma once
// Common parts of all film frames: a title above, and the scale of simulated time below.
#include "experiments/laboratory/film/canvas.hpp"

namespace laboratory {

/// An interval of simulated time, s.
struct Span {
  double from_s = 0, to_s = 0;
  double length_s() const { return to_s - from_s; }
};

inline constexpr int FRAME_MARGIN = 24, TITLE_HEIGHT = 40, TIME_SCALE_HEIGHT = 58;  ///< pixels

/// Draws the title, shortened to the width of the canvas.
void draw_title(Canvas& canvas, const std::string& title);

/// Draws the film's time axis with tick marks at the foot of the canvas, filled up to the end of
/// `now`, with `now` itself darker. A label gives the present time, to a hundredth of the whole or
/// finer.
void draw_time_scale(Canvas& canvas, const Span& film, const Span& now);

/// Formats a time for that label: "12.5 ms". `whole_s` determines unit and digits.
std::string format_time(double time_s, double whole_s);

}  // namespace laboratory
