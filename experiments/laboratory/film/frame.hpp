#pragma once
// Parts that all frames of films have: a title at the top, and an axis of simulated time at the
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

/// Draws the film's time axis with tick marks along the lower edge of the canvas. `film` is the
/// time span of the axis, and `now` the span of this frame. The axis is filled up to the end of
/// `now`, and darker within `now`. A label shows the current time, with a resolution of 1/100 of
/// the film's length or finer.
void draw_time_scale(Canvas& canvas, const Span& film, const Span& now);

/// Formats a time like the labels of the time axis: "12.5 ms". The length of the axis, `whole_s`,
/// determines the unit and the number of digits.
std::string format_time(double time_s, double whole_s);

}  // namespace laboratory
