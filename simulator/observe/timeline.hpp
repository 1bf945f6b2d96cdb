#pragma once
// A trace reduced to pixel columns for a chart. The size is independent of the trace's length.
#include <array>
#include <vector>

#include "simulator/observe/trace.hpp"

namespace observe {

/// One CPU or link direction. Each column holds fractions of its time. For a CPU they are indexed
/// by Trace::Doing; for a link the first is the fraction with messages.
struct TimelineRow {
  using Shares = std::array<double, 3>;
  std::vector<Shares> columns;
  double busy_s = 0;
};

/// A period during which a CPU mainly executes one process, in columns. Each interruption is
/// shorter than a column, and all interruptions together take less than two fifths.
struct TimelineStretch {
  double from, to;
  std::uint32_t process;
};

struct Timeline {
  std::vector<TimelineRow> cpus;
  std::vector<std::vector<TimelineStretch>> stretches;  ///< by CPU; at least three columns long
  std::vector<TimelineRow> links;  ///< by link number in the Trace; without columns if not shown
};

/// Makes a timeline for the first `processors` of a trace and for those of their outgoing link
/// directions that have traffic.
Timeline make_timeline(const Trace& trace, std::size_t processors, std::size_t columns);

}  // namespace observe
