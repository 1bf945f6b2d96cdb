#include "simulator/programs/network/traffic.hpp"

#include "base/random.hpp"
#include "simulator/network/store_and_forward.hpp"
#include "simulator/observe/latencies.hpp"
#include "simulator/observe/mean.hpp"
#include "simulator/programs/declare/support.hpp"

namespace programs {

std::vector<Arrival> make_random_traffic(int processors, const network::Destinations& destinations,
                                         double packets_per_s, double window_us,
                                         std::uint64_t seed) {
  std::vector<Arrival> arrivals;
  for (int from = 0; from < processors; ++from) {
    base::Random random(seed, from);
    for (double at = 0;;) {
      at += random.exponential() / packets_per_s * 1e6;
      if (at > window_us) break;
      const auto to = destinations.draw(from, random);
      if (!to) break;
      arrivals.push_back({std::llround(at), from, *to});
    }
  }
  return arrivals;
}

std::vector<Arrival> make_uniform_traffic(int processors, double packets_per_s, double window_us,
                                          std::uint64_t seed) {
  if (processors == 1) return {};
  topologies::Topology any;
  any.processors = processors;
  return make_random_traffic(processors, network::Destinations({}, any), packets_per_s, window_us,
                             seed);
}

namespace {

topologies::RoutingTable routes_of(const Setup& setup) {
  return setup.routes.rule ? setup.routes : topologies::make_routes(setup.topology);
}

}  // namespace

TrafficResult run_traffic(const Setup& setup, const std::vector<Arrival>& arrivals,
                          std::uint64_t bytes) {
  const int n = setup.topology.processors;
  Machine machine(setup, n);
  network::StoreAndForward network(machine, setup.topology, routes_of(setup));
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
    result.link_loads.push_back(link->use().busy / machine.now());
  for (const double load : result.link_loads)
    result.link_busy_max = std::max(result.link_busy_max, load);
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
  double load = 0.1, window_s = 0.1, warm_up = 0.5;
  network::PatternParams pattern;

  double warm_up_s() const { return warm_up * window_s; }
};

struct Measured {
  std::optional<double> latency_s = {};
  observe::Latencies latencies = {};
  std::size_t packets = 0;
  double links_mean = 0, inside_mean = 0;
  std::size_t longest_queue = 0;
  double link_busy_max = 0;
  std::optional<double> saturation_load = {};
  bool is_saturated = false;
};

constexpr double MOST_PACKETS = 1e7;  // a packet takes about 100 bytes of host memory

std::vector<Arrival> make_arrivals(const Setup& setup, const Params& params,
                                   const network::Destinations& destinations) {
  const int n = setup.topology.processors;
  const double rate = setup.model.link.one_way_rate, bytes = static_cast<double>(params.bytes);
  const double packets = n * params.load * rate / bytes * params.window_s;
  if (packets > MOST_PACKETS)
    base::refuse("program.load, window_s and bytes",
                 "found {:.3g} packets, expected at most {:.3g}", packets, MOST_PACKETS);
  auto arrivals = make_random_traffic(n, destinations, params.load * rate / bytes,
                                      params.window_s * 1e6, params.seed);
  if (arrivals.empty())
    base::refuse("program.window_s",
                 "found a time in which no packet is sent, expected a longer one");
  return arrivals;
}

// Packets sent after the warm-up.
std::vector<observe::Passage> find_measured(const std::vector<Delivery>& deliveries,
                                            const Params& params) {
  std::vector<observe::Passage> passages;
  for (const auto& d : deliveries)
    if (d.sent_s > params.warm_up_s()) passages.push_back({d.sent_s, d.received_s - d.sent_s});
  return passages;
}

bool grows_without_bound(const Setup& setup, const Params& params,
                         const std::vector<Delivery>& deliveries, double later) {
  const double earlier = mean_inside(deliveries, params.window_s / 4, params.window_s / 2);
  return later > 1.6 * earlier && later > setup.topology.processors;
}

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const network::Destinations destinations(params.pattern, setup.topology);
  const auto arrivals = make_arrivals(setup, params, destinations);
  const auto result = run_traffic(setup, arrivals, params.bytes);
  const auto passages = find_measured(result.deliveries, params);
  double sum_s = 0;
  for (const auto& passage : passages) sum_s += passage.latency_s;
  const auto packets = arrivals.size();
  const double later = mean_inside(result.deliveries, 3 * params.window_s / 4, params.window_s);
  Measured m{.latency_s = observe::eval_mean(sum_s, static_cast<double>(passages.size())),
             .latencies = observe::eval_latencies(passages, params.warm_up_s(), params.window_s),
             .packets = packets,
             .links_mean = static_cast<double>(result.links) / static_cast<double>(packets),
             .inside_mean = later,
             .longest_queue = result.longest_queue,
             .link_busy_max = result.link_busy_max,
             .saturation_load = destinations.eval_saturation_load(setup.topology, routes_of(setup)),
             .is_saturated = grows_without_bound(setup, params, result.deliveries, later)};
  const auto drift = describe_drift(m.latencies);
  Outcome<Measured> outcome(m);
  outcome.is_saturated = m.is_saturated;
  add_histograms(outcome, passages, result.link_loads);
  if (!drift.empty() && !m.is_saturated) outcome.notes.push_back(drift);
  return outcome;
}

base::Fields<Params> make_fields() {
  using D = base::Declare<Params>;
  return base::join<base::Field<Params>>(
      {bytes_field<Params>(&Params::bytes),
       D::number("load", &Params::load, 1e-6, 100, "",
                 "bytes that each processor offers, over the capacity of a link direction"),
       D::number("window_s", &Params::window_s, 1e-4, 1e4, "s",
                 "time during which packets are offered"),
       D::number("warm_up", &Params::warm_up, 0, 0.99, "",
                 "part of this time that passes before latencies are measured"),
       seed_field<Params>(&Params::seed, "seed for times and destinations")},
      {base::lift_all<Params>(network::pattern_fields(), &Params::pattern)});
}

base::Columns<Measured> make_columns() {
  return base::join<base::Column<Measured>>(
      {column("latency_s", &Measured::latency_s,
              "mean time of the packets sent after the warm-up; empty if there are none")},
      {base::lift_columns<Measured>(observe::latency_columns(), &Measured::latencies),
       {column("packets", &Measured::packets, "packets sent"),
        column("links_mean", &Measured::links_mean, "mean number of links that a packet passes"),
        column("inside_mean", &Measured::inside_mean,
               "mean number of packets in the network, over the last quarter of the window"),
        column("longest_queue", &Measured::longest_queue,
               "largest number of packets that waited for one link"),
        column("link_busy_max", &Measured::link_busy_max,
               "share of the time that the busiest direction of a link was busy"),
        network::saturation_load_column(&Measured::saturation_load),
        column("saturated", &Measured::is_saturated, "1 if queues grow without bound, else 0")}});
}

}  // namespace traffic

Program make_traffic() {
  using namespace traffic;
  return make_program<Params, Measured>({.name = "traffic",
                                         .help = "random traffic over store-and-forward routers",
                                         .uses = {.network = true, .routes = true, .threads = true},
                                         .fields = make_fields(),
                                         .columns = make_columns(),
                                         .run = &run,
                                         .shows = make_load_shows(),
                                         .voids = [](const Params& params, const std::string& key) {
                                           return find_void(params.pattern, key);
                                         }});
}

}  // namespace programs
