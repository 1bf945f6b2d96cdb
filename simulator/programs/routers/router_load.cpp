// Latency of routers as a function of the load. All processors send messages at a given rate, and
// sink processes receive them at once. At the highest loads, queues grow without bound or overflow.
#include "base/random.hpp"
#include "simulator/network/destinations.hpp"
#include "simulator/observe/latencies.hpp"
#include "simulator/programs/declare/routers.hpp"

namespace programs {

namespace router_load {

using network::Client;
using network::Message;

struct Seen {
  double sum_s = 0;
  // Number of messages offered in the measuring window, and number of these that arrived.
  std::uint64_t offered = 0, count = 0;
  std::uint64_t in_window = 0;  // number of messages that arrived in the window
  std::vector<observe::Passage> passages = {};
};

struct Params {
  RouterParams routers;
  std::uint64_t bytes = 4, seed = 1;
  double load = 0.01, warm_up_s = 0.02, window_s = 0.1;
  network::PatternParams pattern;
};

struct Offers {
  const Params& params;
  double rate_per_s;
  int processors;
  network::Destinations destinations;

  double end_s() const { return params.warm_up_s + params.window_s; }

  // Process that sends a Poisson stream of messages. A message that waits for the router to accept
  // it already counts as offered.
  void offer(Client& client, Seen& seen) const {
    base::Random random(params.seed, client.processor());
    for (double at_s = 0; (at_s += random.exponential() / rate_per_s) < end_s();) {
      occam::wait_until(occam::ticks({at_s}));
      const auto to = destinations.draw(client.processor(), random);
      if (!to) break;
      if (at_s >= params.warm_up_s) ++seen.offered;
      client.send(
          {.to = {*to}, .length = params.bytes, .number = static_cast<std::uint64_t>(at_s * 1e9)});
    }
  }

  void take(Client& client, Seen& seen) const {
    for (;;) {
      const double sent_s = static_cast<double>(client.receive().number) * 1e-9;
      const double here_s = now().value;
      if (here_s >= params.warm_up_s && here_s < end_s()) ++seen.in_window;
      if (sent_s < params.warm_up_s) continue;
      seen.passages.push_back({sent_s, here_s - sent_s});
      seen.sum_s += here_s - sent_s;
      ++seen.count;
    }
  }
};

Offers make_offers(const Setup& setup, const Params& params) {
  const auto whole = static_cast<double>(params.bytes + std::uint64_t{Message::IDENTIFICATION});
  return {params, params.load * setup.model.link.one_way_rate / whole, setup.topology.processors,
          network::Destinations(params.pattern, setup.topology)};
}

constexpr double MOST_MESSAGES = 1e7;

void check_messages(const Offers& offers) {
  const double messages = offers.rate_per_s * offers.end_s() * offers.processors;
  base::require(messages <= MOST_MESSAGES, "program.load, warm_up_s and window_s",
                "found {:.3g} messages, expected at most {:.3g}", messages, MOST_MESSAGES);
}

// Starts a source and a sink process on each processor. Each of them has its own router client.
void start_clients(const Offers& offers, RouterMachine& on, std::vector<Seen>& seen) {
  for (int id = 0; id < offers.processors; ++id) {
    on[id].start(on[id].name() + ".source", Priority::high,
                 [&, id] { offers.offer(on.network->client(id, 1), seen[id]); });
    on[id]
        .start(on[id].name() + ".sink", Priority::high,
               [&, id] { offers.take(on.network->client(id), seen[id]); })
        .set_server();
  }
}

Seen add_up(const std::vector<Seen>& seen) {
  Seen all;
  for (const auto& s : seen) {
    all.sum_s += s.sum_s;
    all.count += s.count;
    all.offered += s.offered;
    all.in_window += s.in_window;
    all.passages.insert(all.passages.end(), s.passages.begin(), s.passages.end());
  }
  return all;
}

struct Measured {
  double offered_per_s = 0;
  std::optional<double> accepted_per_s = {}, latency_s = {};
  observe::Latencies latencies = {};
  double links_mean = 0;
  std::size_t most_held = 0;
  double cpu_busy_max = 0, link_busy_max = 0;
  std::vector<double> link_loads = {};  // load of each link direction
  std::optional<double> saturation_load = {};
  bool has_overflowed = false, is_saturated = false;
};

Measured measure(const Offers& offers, const RouterMachine& on, const Seen& all,
                 bool has_overflowed) {
  const auto& params = offers.params;
  const double now_s = on.now().value;
  // If buffers overflowed, measures only the part of the window before the overflow.
  const double window_s = has_overflowed ? now_s - params.warm_up_s : params.window_s;
  const double time_s = std::max(now_s, params.warm_up_s + window_s);
  Measured m{.offered_per_s = offers.rate_per_s,
             .links_mean = offers.destinations.eval_mean_distance(on.network->routing().routes()),
             .most_held = on.network->use().most_held,
             .saturation_load = offers.destinations.eval_saturation_load(
                 on.network->routing().topology(), on.network->routing().routes()),
             .has_overflowed = has_overflowed};
  if (window_s > 0)
    m.accepted_per_s = static_cast<double>(all.in_window) / window_s / offers.processors;
  if (!has_overflowed && all.count > 0) {
    m.latency_s = all.sum_s / static_cast<double>(all.count);
    m.latencies = observe::eval_latencies(all.passages, params.warm_up_s, offers.end_s());
  }
  double cpu_s = 0;
  for (const auto& processor : on.processors())
    cpu_s = std::max(cpu_s, processor->use().busy().value);
  for (const auto& link : on.links()) m.link_loads.push_back(link->use().busy.value / time_s);
  m.cpu_busy_max = cpu_s / time_s;
  for (const double load : m.link_loads) m.link_busy_max = std::max(m.link_busy_max, load);
  const bool behind = static_cast<double>(all.in_window) < 0.9 * static_cast<double>(all.offered);
  const bool late = now_s - params.warm_up_s - params.window_s > 0.05 * params.window_s;
  m.is_saturated = has_overflowed || (behind && late);
  return m;
}

Outcome<Measured> run(const Setup& setup, const Params& params) {
  check_two_processors(setup);
  const Offers offers = make_offers(setup, params);
  check_messages(offers);
  auto on_network = network_params(params.routers, params.bytes);
  on_network.processes.assign(static_cast<std::size_t>(offers.processors), {~0U, 0});
  RouterMachine on(setup, on_network);
  std::vector<Seen> seen(static_cast<std::size_t>(offers.processors));
  start_clients(offers, on, seen);
  Outcome<Measured> outcome;
  bool has_overflowed = false;
  try {
    run_machine(setup, on, on.view());
  } catch (const network::Overflow& overflow) {
    has_overflowed = true;
    outcome.notes.push_back(fmt::format("{}, at {:.6f} s", overflow.what(), overflow.when.value));
  }
  const Seen all = add_up(seen);
  if (all.count == 0)
    outcome.notes.push_back("found no received message of the window, expected at least one");
  outcome.rows.push_back(measure(offers, on, all, has_overflowed));
  outcome.is_saturated = outcome.rows[0].is_saturated;
  add_histograms(outcome, has_overflowed ? std::vector<observe::Passage>{} : all.passages,
                 outcome.rows[0].link_loads);
  const auto drift = describe_drift(outcome.rows[0].latencies);
  if (!drift.empty() && !outcome.is_saturated) outcome.notes.push_back(drift);
  return outcome;
}

base::Fields<Params> make_fields() {
  using D = base::Declare<Params>;
  return with_routers<Params>(base::join<base::Field<Params>>(
      {message_bytes_field<Params>(&Params::bytes),
       D::number("load", &Params::load, 1e-6, 100, "",
                 "bytes that each processor offers, over the capacity of a link direction"),
       D::number("warm_up_s", &Params::warm_up_s, 0, 1e4, "s",
                 "time before the measurement starts"),
       D::number("window_s", &Params::window_s, 1e-4, 1e4, "s",
                 "time of the measurement, during which messages are offered"),
       seed_field<Params>(&Params::seed, "seed for times and destinations")},
      {base::lift_all<Params>(network::pattern_fields(), &Params::pattern)}));
}

base::Columns<Measured> make_columns() {
  return base::join<base::Column<Measured>>(
      {column("offered_per_s", &Measured::offered_per_s,
              "messages per second that each processor offers"),
       column("accepted_per_s", &Measured::accepted_per_s,
              "messages per second that each processor received during the window"),
       column("latency_s", &Measured::latency_s,
              "mean time of a message; empty if a router overflowed")},
      {base::lift_columns<Measured>(observe::latency_columns(), &Measured::latencies),
       {column("links_mean", &Measured::links_mean, "mean number of links that a message passes"),
        most_held_column(&Measured::most_held),
        column("cpu_busy_max", &Measured::cpu_busy_max,
               "share of the time that the busiest CPU worked"),
        column("link_busy_max", &Measured::link_busy_max,
               "share of the time that the busiest direction of a link was busy"),
        network::saturation_load_column(&Measured::saturation_load),
        column("overflowed", &Measured::has_overflowed, "1 if a router ran out of buffers, else 0"),
        column("saturated", &Measured::is_saturated,
               "1 if queues grow without bound or a router overflowed, else 0")}});
}

}  // namespace router_load

Program make_router_load() {
  using namespace router_load;
  return make_program<Params, Measured>(
      {.name = "router_load",
       .help = "random messages at a constant rate, up to saturation",
       .uses = {.network = true, .routes = true, .others = true},
       .fields = make_fields(),
       .columns = make_columns(),
       .run = &run,
       .shows = make_load_shows(),
       .voids = [](const Params& params, const std::string& key) {
         return find_void(params.pattern, key);
       }});
}

}  // namespace programs
