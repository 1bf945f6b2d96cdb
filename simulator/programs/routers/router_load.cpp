// The usual load-latency curve of routers: all processors offer messages to others at a rate, and
// sinks take them at once; up to the load at which queues grow without bound, or out of their
// buffers.
#include "base/errors.hpp"
#include "simulator/declare/random.hpp"
#include "simulator/declare/routers.hpp"

namespace programs {

namespace {

using network::Client;
using network::Message;

struct Seen {
  double sum_s = 0;
  std::uint64_t offered = 0, count = 0;  // messages offered in the window; of those, received
  std::uint64_t in_window = 0;           // received in the window
};

struct Load {
  double rate_per_s, warm_up_s, window_s;
  std::uint64_t bytes, seed;
  int processors;

  // A Poisson stream; a message that must wait for the router has been offered all the same.
  void offer(Client& client, Seen& seen) const {
    Random random(seed, client.processor());
    const double end_s = warm_up_s + window_s;
    for (double at_s = 0; (at_s += random.exponential() / rate_per_s) < end_s;) {
      occam::wait_until(occam::ticks({at_s}));
      Message message;
      message.to.processor = random.other_than(client.processor(), processors);
      message.length = bytes;
      message.number = static_cast<std::uint64_t>(at_s * 1e9);
      if (at_s >= warm_up_s) ++seen.offered;
      client.send(std::move(message));
    }
  }

  void take(Client& client, Seen& seen) const {
    for (;;) {
      const double sent_s = static_cast<double>(client.receive().number) * 1e-9;
      const double here_s = now().value;
      if (here_s >= warm_up_s && here_s < warm_up_s + window_s) ++seen.in_window;
      if (sent_s < warm_up_s) continue;
      seen.sum_s += here_s - sent_s;
      ++seen.count;
    }
  }
};

Load make_load(const Setup& setup) {
  const double link = setup.model.link.one_way_rate;
  const auto bytes = setup.whole("message_bytes");
  const double whole = static_cast<double>(bytes + std::int64_t{Message::IDENTIFICATION});
  return {setup["load"] * link / whole,
          setup["warm_up_s"],
          setup["window_s"],
          static_cast<std::uint64_t>(bytes),
          static_cast<std::uint64_t>(setup.whole("seed")),
          setup.topology.processors};
}

constexpr double MOST_MESSAGES = 1e7;

void check_load(const Load& load) {
  if (load.processors < 2)
    throw base::BadInput("network.topology: found one processor, expected at least two");
  const double messages = load.rate_per_s * (load.warm_up_s + load.window_s) * load.processors;
  if (messages > MOST_MESSAGES)
    throw base::BadInput(
        fmt::format("program.load, warm_up_s and window_s: found {:.3g} messages, expected at most "
                    "{:.3g}",
                    messages, MOST_MESSAGES));
}

// The source has a channel of its own into the router, the sink one from it.
void start_clients(const Load& load, RouterMachine& on, std::vector<Seen>& seen) {
  for (int id = 0; id < load.processors; ++id) {
    auto& processor = *on.machine.processors()[id];
    processor.start(fmt::format("p{}.source", id), Priority::high,
                    [&, id] { load.offer(on.network->client(id, 1), seen[id]); });
    processor
        .start(fmt::format("p{}.sink", id), Priority::high,
               [&, id] { load.take(on.network->client(id), seen[id]); })
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
  }
  return all;
}

Row make_row(const Load& load, const RouterMachine& on, const Seen& all, bool overflowed) {
  const double now_s = on.machine.now().value, none = std::numeric_limits<double>::quiet_NaN();
  // Of the window, what was before the end or the overflow.
  const double window_s = overflowed ? now_s - load.warm_up_s : load.window_s;
  const double accepted = static_cast<double>(all.in_window) / window_s / load.processors;
  const double time_s = std::max(now_s, load.warm_up_s + window_s);
  double cpu_s = 0, link_s = 0;
  for (const auto& processor : on.machine.processors())
    cpu_s = std::max(cpu_s, processor->use().busy().value);
  for (const auto& link : on.machine.links()) link_s = std::max(link_s, link->use().busy.value);
  const bool behind = static_cast<double>(all.in_window) < 0.9 * static_cast<double>(all.offered);
  const bool late = now_s - load.warm_up_s - load.window_s > 0.05 * load.window_s;
  const bool has_latency = !overflowed && all.count > 0;
  return {{"offered_per_s", load.rate_per_s},
          {"accepted_per_s", window_s > 0 ? accepted : none},
          {"latency_s", has_latency ? all.sum_s / static_cast<double>(all.count) : none},
          {"links_mean", on.network->routing().mean_distance()},
          {"most_held", static_cast<double>(on.network->use().most_held)},
          {"cpu_busy_max", cpu_s / time_s},
          {"link_busy_max", link_s / time_s},
          {"overflowed", overflowed ? 1.0 : 0.0},
          {"saturated", overflowed || (behind && late) ? 1.0 : 0.0}};
}

Rows run(const Setup& setup) {
  const Load load = make_load(setup);
  check_load(load);
  auto params = network_params(setup, load.bytes);
  params.processes.assign(static_cast<std::size_t>(load.processors), {~0U, 0});
  RouterMachine on(setup, params);
  std::vector<Seen> seen(static_cast<std::size_t>(load.processors));
  start_clients(load, on, seen);
  std::vector<std::string> notes;
  bool overflowed = false;
  try {
    run_machine(setup, on.machine);
  } catch (const network::Overflow& overflow) {
    overflowed = true;
    notes.push_back(fmt::format("{}, at {:.6f} s", overflow.what(), overflow.when.value));
  }
  const Seen all = add_up(seen);
  if (all.count == 0) notes.push_back("no message of the window was received");
  return Rows({make_row(load, on, all, overflowed)}, notes);
}

}  // namespace

Pattern make_router_load() {
  return {.name = "router_load",
          .help =
              "random messages at a rate: latency_s and accepted_per_s of each processor, up to "
              "saturation; overflowed, where a router ran out of buffers",
          .uses_topology = true,
          .parameters = router_parameters(
              {message_bytes_parameter(),
               {"load", 0.01, 1e-6, 100, false,
                "bytes that each processor offers, over what a link direction carries"},
               {"warm_up_s", 0.02, 0, 1e4, false, "before anything is measured"},
               {"window_s", 0.1, 1e-4, 1e4, false, "how long messages are offered then"},
               {"seed", 1, 0, 1e15, true, "of times and destinations"}}),
          .run = &run,
          .uses_routes = true};
}

}  // namespace programs
