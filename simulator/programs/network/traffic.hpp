#pragma once
// Packets offered to a network of routers at given dates, and their delays.
#include <vector>

#include "simulator/programs/declare/program.hpp"

namespace programs {

struct Arrival {
  std::int64_t at_us;  ///< date of the offer in whole microseconds, ascending for each source
  int from, to;
};

/// Makes uniform traffic: each processor sends a Poisson stream of `packets_per_s` to random others
/// during `window_us`. A seed gives the same packets on every machine.
std::vector<Arrival> make_uniform_traffic(int processors, double packets_per_s, double window_us,
                                          std::uint64_t seed);

struct Delivery {
  double sent_s, received_s;
};

struct TrafficResult {
  std::vector<Delivery> deliveries;  ///< one for each arrival, in the same order
  double link_busy_max = 0;          ///< fraction of time of the busiest link direction
  std::size_t longest_queue = 0;     ///< in packets
  std::uint64_t links = 0;           ///< total number of links passed by all packets
};

/// Simulates store-and-forward routing of packets of `bytes` bytes on the topology of `setup`,
/// until all have arrived.
TrafficResult run_traffic(const Setup& setup, const std::vector<Arrival>& arrivals,
                          std::uint64_t bytes);

}  // namespace programs
