#pragma once
// Parts shared by the small programs.
#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "simulator/observe/histogram.hpp"
#include "simulator/occam/alt.hpp"
#include "simulator/occam/process.hpp"
#include "simulator/programs/declare/program.hpp"

namespace programs {

using occam::Channel;
using occam::Cycles;
using occam::Priority;
using occam::Seconds;
using occam::this_process;

/// A message of given length whose contents do not matter.
struct Message {
  std::uint64_t length = 0;
  std::uint64_t bytes() const { return length; }
};

/// Memory in bytes of processors that run bare code, whose programs allocate nothing.
constexpr std::uint64_t MEMORY = 1 << 20;
constexpr Seconds START{1024e-6};  ///< at this date every process is waiting for input

inline Seconds now() { return this_process().now(); }
inline void wait_for_start() { occam::wait_until(occam::ticks(START)); }
inline void compute(Cycles cycles) { this_process().charge(cycles); }

/// A machine with unconnected processors p0, p1, ... If it has as many processors as the topology,
/// they have the topology's labels instead.
struct Machine : machine::Machine {
  Machine(const Setup& setup, int count, machine::Code code = machine::Code::bare)
      : machine::Machine(setup.model, code, setup.engine) {
    const bool is_topology = count == setup.topology.processors;
    for (int id = 0; id < count; ++id) {
      const auto number = fmt::format("p{}", id);
      const auto memory =
          code == machine::Code::bare ? MEMORY : get_bytes(setup.model_of(id), "worker_memory");
      add_processor(is_topology ? name_of(setup.topology, id, number) : number, memory, {},
                    find_model(setup.others, id));
    }
  }
  machine::Processor& operator[](int id) const { return *processors()[id]; }
};

/// A line of processors p0 - p1 - ..., with a channel from each processor to the next one.
struct Line : Machine {
  Line(const Setup& setup, int count) : Machine(setup, count) {
    for (int id = 0; id + 1 < count; ++id) {
      auto &here = (*this)[id], &next = (*this)[id + 1];
      connect(here, next);
      channels.emplace_back(next.name() + ".in", link(here, next));
    }
  }
  std::deque<Channel<Message>> channels;
};

/// The field "bytes": length of a message in bytes.
template <class P, class Access>
base::Field<P> bytes_field(Access access, double low = 1) {
  return base::Declare<P>::whole("bytes", access, low, 1e9, "bytes", "length of a message");
}

/// The field "seed" of a stream of random numbers. `help` says what the numbers are for.
template <class P, class Access>
base::Field<P> seed_field(Access access, const std::string& help) {
  return base::Declare<P>::whole("seed", access, 0, 1e15, "", help);
}

/// A field "seed" that accepts every non-negative integer.
template <class P, class Access>
base::Field<P> whole_seed_field(Access access, const std::string& help) {
  auto field = seed_field<P>(access, help);
  field.domain.high = 0x1p63;
  field.domain.expected = fmt::format("a whole number from 0 to {}", INT64_MAX);
  return field;
}

/// What a program shows that offers a load to a network: it has the parameter "load", the columns
/// "saturated" and "saturation_load", and histograms of latencies and loads of links.
inline Shows make_load_shows() {
  return {.histograms = {observe::LATENCY_HISTOGRAM, observe::LINK_HISTOGRAM},
          .saturation = SaturationColumns{"saturated", "load", "saturation_load",
                                          "bound by the busiest link"}};
}

/// Adds the rows of histogram.csv.
inline void add_histograms(Extras& outcome, const std::vector<observe::Passage>& passages,
                           const std::vector<double>& link_loads) {
  for (const auto& histogram :
       {observe::make_latency_histogram(passages), observe::make_link_histogram(link_loads)})
    for (auto& row : observe::make_rows(histogram)) outcome.histogram.push_back(std::move(row));
}

/// The value that names a processor in a table: its label, or its number if the topology has no
/// labels.
inline base::Cell processor_cell(const topologies::Topology& topology, int id) {
  if (topology.labels.empty()) return static_cast<std::int64_t>(id);
  return topology.labels.at(id);
}

}  // namespace programs
