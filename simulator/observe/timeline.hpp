#pragma once
// A trace reduced to the pixel columns of a chart. The size does not depend on the trace's length.
#include <array>
#include <vector>

#include "simulator/observe/trace.hpp"

namespace observe {

/// One CPU or one direction of a link. For each column, the fractions of the column's time spent in
/// each activity. For a CPU, index 0, 1, 2 is an activity of Trace::Doing; for a link, index 0 is
/// the fraction of time with messages.
struct TimelineRow {
  using Shares = std::array<double, 3>;
  std::vector<Shares> columns;
  double busy_s = 0;
};

/// A period during which a CPU mainly executes one process. Positions are in columns. Each
/// interruption is shorter than a column, and all interruptions together take less than two fifths
/// of the period.
struct TimelineStretch {
  double from, to;
  std::uint32_t process;
};

struct Timeline {
  std::vector<TimelineRow> cpus;
  /// The stretches of each CPU that are at least three columns long.
  std::vector<std::vector<TimelineStretch>> stretches;
  /// The row of each link of the Trace; links that are not shown have no columns.
  std::vector<TimelineRow> links;
};

/// Makes a timeline of the first `processors` processors of a trace, and of their outgoing link
/// directions that carried messages.
Timeline make_timeline(const Trace& trace, std::size_t processors, std::size_t columns);

}  // namespace observe
