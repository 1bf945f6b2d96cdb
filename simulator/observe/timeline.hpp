#pragma once
// A trace in pixel columns, before it is drawn: what a chart needs however long the trace was.
#include <array>
#include <vector>

#include "simulator/observe/trace.hpp"

namespace observe {

/// One CPU or link direction. A column holds shares of its time: a CPU's by Trace::Doing, a link's
/// share of messages as the first. The rest is idle.
struct TimelineRow {
  using Shares = std::array<double, 3>;
  std::vector<Shares> columns;
  double busy_s = 0;
};

/// A stretch of a CPU's time, in columns, that belongs to one process: interrupted for less than a
/// column each time, and for less than two fifths altogether.
struct TimelineStretch {
  double from, to;
  std::uint32_t process;
};

struct Timeline {
  std::vector<TimelineRow> cpus;
  std::vector<std::vector<TimelineStretch>> stretches;  ///< by CPU, three columns long or more
  std::vector<TimelineRow> links;  ///< by Trace's number; without columns if it is not shown
};

/// The timeline of the first `processors` of a trace and the directions that leave them and carried
/// anything.
Timeline make_timeline(const Trace& trace, std::size_t processors, std::size_t columns);

}  // namespace observe
