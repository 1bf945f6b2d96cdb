#include "simulator/observe/timeline.hpp"

#include <algorithm>

namespace observe {

namespace {

// Converts a time in seconds into a position on the chart in pixel columns.
struct Scale {
  double begin_s, per_second, columns;
  double operator()(double time_s) const {
    return std::clamp((time_s - begin_s) * per_second, 0.0, columns);
  }
};

void add(TimelineRow& row, double from, double to, std::size_t kind, const Scale& scale) {
  row.busy_s += (to - from) / scale.per_second;
  for (auto column = static_cast<std::size_t>(from); static_cast<double>(column) < to; ++column) {
    const auto left = static_cast<double>(column);
    row.columns[column][kind] += std::min(to, left + 1) - std::max(from, left);
  }
}

// A period of a process, in columns of the chart. The period may still be extended. `own` is the
// time of the process itself, without the interruptions.
struct Open {
  double from = 0, to = -2, own = 0;
};

void close(const Open& open, std::uint32_t process, std::vector<TimelineStretch>& stretches) {
  const double length = open.to - open.from;
  if (length >= 3 && open.own > 0.6 * length) stretches.push_back({open.from, open.to, process});
}

}  // namespace

Timeline make_timeline(const Trace& trace, std::size_t processors, std::size_t columns) {
  const auto width = static_cast<double>(columns);
  const double length_s = std::max(trace.end_s - trace.begin_s, 1e-9);
  const Scale scale{trace.begin_s, width / length_s, width};
  Timeline timeline;
  timeline.cpus.assign(processors, {std::vector<TimelineRow::Shares>(columns), 0});
  timeline.stretches.resize(processors);
  timeline.links.resize(trace.links.size());

  std::vector<Open> open(trace.processes.size());
  for (const auto& span : trace.spans) {
    if (span.processor >= processors) continue;
    const double from = scale(span.from_s), to = scale(span.to_s);
    add(timeline.cpus[span.processor], from, to, static_cast<std::size_t>(span.doing), scale);
    if (span.doing == Trace::Doing::switching) continue;
    auto& stretch = open[span.process];
    if (from >= stretch.to + 1) {
      close(stretch, span.process, timeline.stretches[span.processor]);
      stretch = {from, from, 0};
    }
    stretch.to = to;
    stretch.own += to - from;
  }
  for (std::uint32_t i = 0; i < open.size(); ++i)
    if (trace.processes[i].processor < processors)
      close(open[i], i, timeline.stretches[trace.processes[i].processor]);

  for (const auto& transfer : trace.transfers) {
    const double from = scale(transfer.from_s), to = scale(transfer.to_s);
    if (trace.links[transfer.link].from >= processors || !(from < to)) continue;
    auto& row = timeline.links[transfer.link];
    row.columns.resize(columns);
    add(row, from, to, 0, scale);
  }
  return timeline;
}

}  // namespace observe
