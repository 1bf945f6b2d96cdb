#pragma once
// A trace reduced to pixel columns for a chart; its size does not depend on the trace's length.
#include <array>
#include <vector>

#include "simulator/observe/trace.hpp"

namespace observe {

/// One CPU or link direction. A column has shares of its time: by Trace::Doing for a CPU, the share
/// of messages (as first) for a link. The rest is idle.
struct TimelineRow {
  using Shares = std::array<double, 3>;
  std::vector<Shares> columns;
  double busy_s = 0;
};

/// A stretch of a CPU's time, in columns, that belongs to one process. Each interruption is shorter
/// than a column, and all together are shorter than two fifths.
struct TimelineStretch {
  double from, to;
  std::uint32_t process;
};

struct Timeline {
  std::vector<TimelineRow> cpus;
  std::vector<std::vector<TimelineStretch>> stretches;  ///< by CPU, three columns long or more
  std::vector<TimelineRow> links;  ///< by Trace's number; without columns if not shown
};

/// Timeline of the first `processors` of a trace, and of their outgoing link directions with
/// traffic.
Timeline make_timeline(const Trace& trace, std::size_t processors, std::size_t columns);

}  // namespace observe
