#include "simulator/programs/network/traffic.hpp"

#include <cmath>

#include "base/errors.hpp"
#include "simulator/declare/random.hpp"
#include "simulator/declare/support.hpp"
#include "simulator/network/store_and_forward.hpp"

namespace programs {

std::vector<Arrival> make_uniform_traffic(int processors, double packets_per_s, double window_us,
                                          std::uint64_t seed) {
  std::vector<Arrival> arrivals;
  for (int from = 0; from < processors && processors > 1; ++from) {
    Random random(seed, from);
    for (double at = 0;;) {
      at += random.exponential() / packets_per_s * 1e6;
      if (at > window_us) break;
      arrivals.push_back({std::llround(at), from, random.other_than(from, processors)});
    }
  }
  return arrivals;
}

TrafficResult run_traffic(const Setup& setup, const std::vector<Arrival>& arrivals,
                          std::uint64_t bytes) {
  const int n = setup.topology.processors;
  machine::Machine machine(setup.model);
  add_processors(machine, n);
  network::StoreAndForward network(machine, setup.topology);
  TrafficResult result;
  result.deliveries.resize(arrivals.size());
  std::vector<std::vector<std::uint64_t>> to_send(n);  // indices of arrivals
  std::vector<std::size_t> to_receive(n);
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    to_send[arrivals[i].from].push_back(i);
    ++to_receive[arrivals[i].to];
    result.hops +=
        static_cast<std::uint64_t>(network.routes().distance(arrivals[i].from, arrivals[i].to));
  }
  for (int id = 0; id < n; ++id) {
    machine.processors()[id]->start("source", Priority::high, [&, id] {
      network::Pointer packet;
      for (const auto i : to_send[id]) {
        occam::wait_until(arrivals[i].at_us);
        result.deliveries[i].sent_s = 1e-6 * static_cast<double>(arrivals[i].at_us);
        packet.to = {id, arrivals[i].to, bytes, i, {}};
        out(network.into(id), packet);
      }
    });
    machine.processors()[id]->start("sink", Priority::high, [&, id] {
      for (std::size_t received = 0; received < to_receive[id]; ++received) {
        const auto packet = network.delivered(id).in();
        result.deliveries[packet.to.id].received_s = now().value;
      }
    });
  }
  run_machine(setup, machine);
  for (const auto& link : machine.links())
    result.link_busy_max = std::max(result.link_busy_max, link->use().busy / machine.now());
  result.longest_queue = network.longest_queue();
  return result;
}

namespace {

// Packets in the network, on average over a part of the window.
double mean_inside(const std::vector<Delivery>& deliveries, double from_s, double to_s) {
  double inside_s = 0;
  for (const auto& d : deliveries)
    inside_s += std::max(0.0, std::min(d.received_s, to_s) - std::max(d.sent_s, from_s));
  return inside_s / (to_s - from_s);
}

constexpr double MOST_PACKETS = 1e7;  // each takes some 100 bytes of the host's memory

Row run(const Setup& setup) {
  const double window_s = setup["window_s"], rate = setup.model.link.one_way_rate;
  const double packets =
      setup.topology.processors * setup["load"] * rate / setup["bytes"] * window_s;
  if (packets > MOST_PACKETS)
    throw base::BadInput(fmt::format(
        "program.load, window_s and bytes: found {:.3g} packets, expected at most {:.3g}", packets,
        MOST_PACKETS));
  const auto arrivals =
      make_uniform_traffic(setup.topology.processors, setup["load"] * rate / setup["bytes"],
                           window_s * 1e6, static_cast<std::uint64_t>(setup.whole("seed")));
  if (arrivals.empty()) throw base::BadInput("program.window_s: so short that no packet is sent");
  const auto result =
      run_traffic(setup, arrivals, static_cast<std::uint64_t>(setup.whole("bytes")));
  // Of the packets sent in the second half, when the queues have filled.
  double sum_s = 0, count = 0;
  for (const auto& d : result.deliveries)
    if (d.sent_s > window_s / 2) sum_s += d.received_s - d.sent_s, ++count;
  const double earlier = mean_inside(result.deliveries, window_s / 4, window_s / 2);
  const double later = mean_inside(result.deliveries, 3 * window_s / 4, window_s);
  const bool saturated = later > 1.6 * earlier && later > setup.topology.processors;
  return {{"latency_s", sum_s / std::max(count, 1.0)},
          {"packets", static_cast<double>(arrivals.size())},
          {"hops_mean", static_cast<double>(result.hops) / static_cast<double>(arrivals.size())},
          {"inside_mean", later},
          {"longest_queue", static_cast<double>(result.longest_queue)},
          {"link_busy_max", result.link_busy_max},
          {"saturated", saturated ? 1.0 : 0.0}};
}

}  // namespace

Pattern make_traffic() {
  return {
      "traffic",
      "uniform random traffic over store-and-forward routers: latency_s, on average; saturated, "
      "where queues grow without bound",
      true,
      {bytes_parameter(1),
       {"load", 0.1, 1e-6, 100, false,
        "bytes that each processor offers, over what a link direction carries"},
       {"window_s", 0.1, 1e-4, 1e4, false, "how long packets are offered"},
       {"seed", 1, 0, 1e15, true, "of times and destinations"}},
      &run};
}

}  // namespace programs
