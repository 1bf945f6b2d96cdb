#pragma once
// What the frames of all films have: a title above, and the scale of simulated time below.
#include "experiments/laboratory/film/canvas.hpp"

namespace laboratory {

/// A stretch of simulated time, s.
struct Span {
  double from_s = 0, to_s = 0;
  double length_s() const { return to_s - from_s; }
};

inline constexpr int FRAME_MARGIN = 24, TITLE_HEIGHT = 40, TIME_SCALE_HEIGHT = 58;  ///< pixels

/// Draws as much of the title as there is room for.
void draw_title(Canvas& canvas, const std::string& title);

/// Draws an axis of the time that the film shows, at the foot of the canvas, with marks, filled up
/// to the present, which is the end of `now`; what `now` covers is darker. The present is said in
/// words, to a hundredth of the whole or finer.
void draw_time_scale(Canvas& canvas, const Span& film, const Span& now);

/// A time as it is said there: "12.5 ms". `whole_s` is the length that decides unit and digits.
std::string format_time(double time_s, double whole_s);

}  // namespace laboratory
