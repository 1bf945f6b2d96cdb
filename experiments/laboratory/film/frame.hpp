#pragma once
// Common parts of all film frames: a title at the top, and the scale of simulated time at the
// bottom.
#include "experiments/laboratory/film/canvas.hpp"

namespace laboratory {

/// An interval of simulated time, s.
struct Span {
  double from_s = 0, to_s = 0;
  double length_s() const { return to_s - from_s; }
};

/// margins and heights of a frame's parts, pixels
inline constexpr int FRAME_MARGIN = 24, TITLE_HEIGHT = 40, TIME_SCALE_HEIGHT = 58;

/// Draws the title, shortened to the width of the canvas.
void draw_title(Canvas& canvas, const std::string& title);

/// Draws the film's time axis with tick marks along the lower edge of the canvas. The axis is
/// filled up to the end of `now`, the interval of this frame; the part for `now` is darker. A label
/// shows the current time to 1/100 of the whole film or finer.
void draw_time_scale(Canvas& canvas, const Span& film, const Span& now);

/// Formats a time as the label of the time axis does: "12.5 ms". The length of the axis, `whole_s`,
/// determines unit and digits.
std::string format_time(double time_s, double whole_s);

}  // namespace laboratory
