#include "simulator/programs/network/traffic.hpp"

#include "base/random.hpp"
#include "simulator/network/store_and_forward.hpp"
#include "simulator/observe/mean.hpp"
#include "simulator/programs/declare/support.hpp"

namespace programs {

std::vector<Arrival> make_uniform_traffic(int processors, double packets_per_s, double window_us,
                                          std::uint64_t seed) {
  std::vector<Arrival> arrivals;
  for (int from = 0; from < processors && processors > 1; ++from) {
    base::Random random(seed, from);
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
  Machine machine(setup, n);
  network::StoreAndForward network(machine, setup.topology);
  TrafficResult result;
  result.deliveries.resize(arrivals.size());
  // Indices into `arrivals`, by sending processor.
  std::vector<std::vector<std::uint64_t>> to_send(n);
  std::vector<std::size_t> to_receive(n);
  for (std::size_t i = 0; i < arrivals.size(); ++i) {
    to_send[arrivals[i].from].push_back(i);
    ++to_receive[arrivals[i].to];
    result.links +=
        static_cast<std::uint64_t>(network.routes().distance(arrivals[i].from, arrivals[i].to));
  }
  for (int id = 0; id < n; ++id) {
    machine[id].start("source", Priority::high, [&, id] {
      for (const auto i : to_send[id]) {
        occam::wait_until(arrivals[i].at_us);
        result.deliveries[i].sent_s = 1e-6 * static_cast<double>(arrivals[i].at_us);
        out(network.into(id), network::Pointer{{id, arrivals[i].to, bytes, i}});
      }
    });
    machine[id].start("sink", Priority::high, [&, id] {
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

namespace traffic {

// Mean number of packets in the network between two dates in seconds.
double mean_inside(const std::vector<Delivery>& deliveries, double from_s, double to_s) {
  double inside_s = 0;
  for (const auto& d : deliveries)
    inside_s += std::max(0.0, std::min(d.received_s, to_s) - std::max(d.sent_s, from_s));
  return inside_s / (to_s - from_s);
}

struct Params {
  std::uint64_t bytes = 100, seed = 1;
  double load = 0.1, window_s = 0.1;
};

struct Measured {
  std::optional<double> latency_s = {};
  std::size_t packets = 0;
  double links_mean = 0, inside_mean = 0;
  std::size_t longest_queue = 0;
  double link_busy_max = 0;
  bool is_saturated = false;
};

constexpr double MOST_PACKETS = 1e7;  // a packet takes about 100 bytes of host memory

std::vector<Arrival> make_arrivals(const Setup& setup, const Params& params) {
  const int n = setup.topology.processors;
  const double rate = setup.model.link.one_way_rate, bytes = static_cast<double>(params.bytes);
  const double packets = n * params.load * rate / bytes * params.window_s;
  if (packets > MOST_PACKETS)
    base::refuse("program.load, window_s and bytes",
                 "found {:.3g} packets, expected at most {:.3g}", packets, MOST_PACKETS);
  auto arrivals =
      make_uniform_traffic(n, params.load * rate / bytes, params.window_s * 1e6, params.seed);
  if (arrivals.empty())
    base::refuse("program.window_s",
                 "found a time in which no packet is sent, expected a longer one");
  return arrivals;
}

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const auto arrivals = make_arrivals(setup, params);
  const auto result = run_traffic(setup, arrivals, params.bytes);
  const double window_s = params.window_s;
  // Counts only packets sent in the second half of the window. By then the queues have reached
  // their usual length.
  double sum_s = 0, count = 0;
  for (const auto& d : result.deliveries)
    if (d.sent_s > window_s / 2) sum_s += d.received_s - d.sent_s, ++count;
  const double earlier = mean_inside(result.deliveries, window_s / 4, window_s / 2);
  const double later = mean_inside(result.deliveries, 3 * window_s / 4, window_s);
  const bool is_saturated = later > 1.6 * earlier && later > setup.topology.processors;
  const double links = static_cast<double>(result.links) / static_cast<double>(arrivals.size());
  Outcome<Measured> outcome(Measured{observe::eval_mean(sum_s, count), arrivals.size(), links,
                                     later, result.longest_queue, result.link_busy_max,
                                     is_saturated});
  outcome.is_saturated = is_saturated;
  return outcome;
}

}  // namespace traffic

Program make_traffic() {
  using namespace traffic;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "traffic",
       .help = "uniform random traffic over store-and-forward routers",
       .uses = {.network = true, .threads = true},
       .fields = {bytes_field<Params>(&Params::bytes),
                  D::number(
                      "load", &Params::load, 1e-6, 100, "",
                      "bytes that each processor offers, over the capacity of a link direction"),
                  D::number("window_s", &Params::window_s, 1e-4, 1e4, "s",
                            "time during which packets are offered"),
                  seed_field<Params>(&Params::seed, "seed for times and destinations")},
       .columns =
           {column("latency_s", &Measured::latency_s,
                   "mean time of the packets sent in the second half of the window; empty if there "
                   "are none"),
            column("packets", &Measured::packets, "packets sent"),
            column("links_mean", &Measured::links_mean,
                   "mean number of links that a packet passes"),
            column("inside_mean", &Measured::inside_mean,
                   "mean number of packets in the network, over the last quarter of the window"),
            column("longest_queue", &Measured::longest_queue,
                   "largest number of packets that waited for one link"),
            column("link_busy_max", &Measured::link_busy_max,
                   "share of the time that the busiest direction of a link was busy"),
            column("saturated", &Measured::is_saturated, "1 if queues grow without bound, else 0")},
       .run = &run});
}

}  // namespace programs
