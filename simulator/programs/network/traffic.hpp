#pragma once
// Packets that processors send at given dates over a network of routers, and their delays.
#include <vector>

#include "simulator/network/destinations.hpp"
#include "simulator/programs/declare/program.hpp"

namespace programs {

struct Arrival {
  /// Date in whole microseconds at which the packet is offered; ascending for each sender.
  std::int64_t at_us;
  int from, to;
};

/// Makes random traffic: during `window_us` microseconds, each processor sends a Poisson stream of
/// `packets_per_s` packets to random destinations. Processors without destinations send none. The
/// packets depend only on the arguments, not on the machine's speed.
std::vector<Arrival> make_random_traffic(int processors, const network::Destinations& destinations,
                                         double packets_per_s, double window_us,
                                         std::uint64_t seed);
/// Like make_random_traffic(), with all other processors as equally probable destinations. A single
/// processor sends none.
std::vector<Arrival> make_uniform_traffic(int processors, double packets_per_s, double window_us,
                                          std::uint64_t seed);

struct Delivery {
  double sent_s, received_s;
};

struct TrafficResult {
  std::vector<Delivery> deliveries;  ///< one for each arrival, in the same order
  std::vector<double> link_loads;    ///< load of each link direction, 0 to 1
  double link_busy_max = 0;          ///< the largest of these
  std::size_t longest_queue = 0;     ///< maximum number of packets in a queue
  std::uint64_t links = 0;           ///< number of links passed by packets, summed over all packets
};

/// Simulates store-and-forward routing of packets with `bytes` bytes on the topology of `setup`,
/// until all packets have arrived. Packets follow the routes of `setup`, or shortest routes if it
/// has none.
TrafficResult run_traffic(const Setup& setup, const std::vector<Arrival>& arrivals,
                          std::uint64_t bytes);

}  // namespace programs
