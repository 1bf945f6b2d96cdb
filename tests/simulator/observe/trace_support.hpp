// Traces for tests: a small one and random ones.
#pragma once

#include <fmt/format.h>

#include <random>
#include <sstream>
#include <string>

#include "simulator/observe/trace.hpp"

namespace observe {

inline std::string saved(void (*save)(const Trace&, std::ostream&), const Trace& trace) {
  std::ostringstream out;
  save(trace, out);
  return out.str();
}

// A trace of 10 ms: one processor sends a message to another.
inline Trace make_small_trace() {
  using enum Trace::Doing;
  Trace trace;
  trace.title = "small";
  trace.processors = {"farmer", "worker"};
  trace.processes = {{"give", 0}, {"take", 1}};
  trace.links = {{0, 1}, {1, 0}};
  trace.channels = {"task"};
  trace.spans = {{0, 0.001, 0, 0, low},
                 {0.004, 0.0041234567, 1, 0, switching},
                 {0.0041234567, 0.01, 1, 1, high}};
  trace.transfers = {{0.001, 0.004, 0, 0, 80}};
  trace.end_s = 0.01;
  return trace;
}

// Names contain special characters. Lanes (processors and links) are full, sparse or empty, and
// spans may have length 0.
inline Trace make_random_trace(std::uint64_t seed) {
  static const std::string names[] = {"worker 1", "\"quoted\"",  "<a> & b", "two\nlines\t\x01",
                                      "é 漢字",   "back\\slash", "",        "%EventDef #1"};
  std::mt19937_64 random(seed);
  const auto below = [&](std::uint64_t n) { return static_cast<std::uint32_t>(random() % n); };
  const auto name = [&] { return names[below(std::size(names))]; };
  Trace trace;
  trace.title = name();
  trace.begin_s = below(2) * 0.25;
  for (auto n = below(20); n > 0; --n) trace.processors.push_back(name());
  const auto processors = trace.processors.size();
  for (std::uint32_t i = 0; i < processors; ++i)
    for (int n = 0; n < 3; ++n) trace.processes.push_back({name(), i});
  for (auto n = processors == 0 ? 0 : below(40); n > 0; --n)
    trace.links.push_back({below(processors), below(processors)});
  for (int n = 0; n < 5; ++n) trace.channels.push_back(name());
  const double scale_s = std::pow(10, -static_cast<double>(below(9)));
  trace.end_s = trace.begin_s + scale_s;

  // Chooses the next span of a lane after its present end. Returns false at the end of the trace.
  const auto pick = [&](double& from_s, double& to_s) {
    const auto step = [&] { return below(3) == 0 ? 0 : scale_s * below(1000) / 2e4; };
    from_s = to_s + step();
    to_s = from_s + step();
    return to_s <= trace.end_s && below(100) != 0;
  };
  for (std::uint32_t i = 0; i < processors; ++i)
    for (double from_s = 0, to_s = trace.begin_s; below(8) != 0 && pick(from_s, to_s);)
      for (int n = 0; n < 4 && pick(from_s, to_s); ++n)
        trace.spans.push_back({from_s, to_s, i, 3 * i + below(3), Trace::Doing(below(3))});
  for (std::uint32_t i = 0; i < trace.links.size(); ++i)
    for (double from_s = 0, to_s = trace.begin_s; below(8) != 0 && pick(from_s, to_s);)
      trace.transfers.push_back({from_s, to_s, i, below(5), random()});
  return trace;
}

}  // namespace observe
