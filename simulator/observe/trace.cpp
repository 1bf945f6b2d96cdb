#include "simulator/observe/trace.hpp"

#include "base/errors.hpp"
#include "simulator/observe/trace_output.hpp"

namespace observe {

namespace {

void check_index(const char* what, std::size_t index, std::size_t size) {
  if (index >= size)
    throw base::InvariantBroken(
        fmt::format("trace: {} {}, but there are only {}", what, index, size));
}

// Checks the times of one item. `ends` holds the end of the last item in each lane (processor or
// link) and is updated.
template <class Item>
void check_times(const char* what, const Item& item, std::size_t lane, std::vector<double>& ends) {
  constexpr double hair_s = 1e-9;
  check_index(what, lane, ends.size());
  if (!(item.from_s >= ends[lane] - hair_s && item.to_s >= item.from_s))
    throw base::InvariantBroken(fmt::format(
        "trace: {} {} has an item from {} to {} s, which overlaps the previous one, until {} s",
        what, lane, item.from_s, item.to_s, ends[lane]));
  ends[lane] = item.to_s;
}

}  // namespace

void check(const Trace& trace) {
  for (const auto& process : trace.processes)
    check_index("processor", process.processor, trace.processors.size());
  for (const auto& link : trace.links) {
    check_index("processor", link.from, trace.processors.size());
    check_index("processor", link.to, trace.processors.size());
  }
  std::vector<double> ends(trace.processors.size(), 0);
  for (const auto& span : trace.spans) {
    check_times("processor", span, span.processor, ends);
    if (span.doing != Trace::Doing::switching)
      check_index("process", span.process, trace.processes.size());
  }
  ends.assign(trace.links.size(), 0);
  for (const auto& transfer : trace.transfers) {
    check_times("link", transfer, transfer.link, ends);
    check_index("channel", transfer.channel, trace.channels.size());
  }
}

}  // namespace observe
