#pragma once
// Packets that are put into a network of routers at given times: how long each takes.
#include <vector>

#include "simulator/declare/program.hpp"

namespace programs {

struct Arrival {
  std::int64_t at_us;  ///< when its source has it: whole microseconds, ascending for each source
  int from, to;
};

/// Uniform traffic: every processor sends packets to any other, each as likely, a Poisson stream of
/// `packets_per_s`, for `window_us`. The same for the same seed on any machine.
std::vector<Arrival> make_uniform_traffic(int processors, double packets_per_s, double window_us,
                                          std::uint64_t seed);

struct Delivery {
  double sent_s, received_s;
};

struct TrafficResult {
  std::vector<Delivery> deliveries;  ///< one for each arrival, in the same order
  double link_busy_max = 0;          ///< share of the time of the busiest link direction
  std::size_t longest_queue = 0;     ///< packets
  std::uint64_t links = 0;           ///< links that all packets pass, added up
};

/// Store and forward over the topology of `setup`, `bytes` a packet, until all are delivered.
TrafficResult run_traffic(const Setup& setup, const std::vector<Arrival>& arrivals,
                          std::uint64_t bytes);

}  // namespace programs
