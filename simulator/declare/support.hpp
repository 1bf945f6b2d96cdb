#pragma once
// What the patterns share.
#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "simulator/declare/program.hpp"
#include "simulator/machine/machine.hpp"
#include "simulator/occam/alt.hpp"
#include "simulator/occam/channel.hpp"
#include "simulator/occam/process.hpp"

namespace programs {

using occam::Channel;
using occam::Cycles;
using occam::Priority;
using occam::Seconds;
using occam::this_process;

// A message of any length.
struct Message {
  std::uint64_t length = 0;
  std::uint64_t bytes() const { return length; }
};

constexpr std::uint64_t MEMORY = 1 << 20;  // bytes of a processor: patterns store nothing
constexpr Seconds START{1024e-6};          // by then every process waits for its input

inline Message make_message_of(const Setup& setup) {
  return {static_cast<std::uint64_t>(setup.whole("bytes"))};
}

inline Seconds now() { return this_process().now(); }
inline void wait_for_start() { occam::wait_until(occam::ticks(START)); }
inline void compute(Cycles cycles) { this_process().charge(cycles); }

// p0, p1, ...: the topology's processors, not yet joined.
inline void add_processors(machine::Machine& machine, int count) {
  for (int id = 0; id < count; ++id) machine.add_processor(fmt::format("p{}", id), MEMORY);
}

// A line p0 - p1 - ... and a channel from each to the next.
struct Line {
  Line(machine::Machine& machine, int count) {
    add_processors(machine, count);
    for (int id = 0; id + 1 < count; ++id) {
      auto &here = *machine.processors()[id], &next = *machine.processors()[id + 1];
      machine.connect(here, next);
      channels.emplace_back(next.name() + ".in", machine.link(here, next));
    }
  }
  std::deque<Channel<Message>> channels;
};

inline Parameter bytes_parameter(double low = 1) {
  return {"bytes", 100, low, 1e9, true, "length of a message"};
}

}  // namespace programs
