// Every processor sends messages to all others at random: what the routers and the application
// that does so take of the CPU (table 5.2).
#include "base/errors.hpp"
#include "simulator/declare/random.hpp"
#include "simulator/declare/routers.hpp"

namespace programs {

namespace {

using network::Client;
using network::Message;

struct Talk {
  const ApplicationCost& cost;
  double pause_s;
  std::uint64_t bytes, seed;
  int processors;

  // One sequential process (LSGP): it takes what comes until its next message is due.
  void run(Client& client) const {
    Random random(seed, client.processor());
    network::Handed handed;
    for (;;) {
      const auto due = occam::ticks(now() + Seconds{pause_s * random.exponential()});
      for (bool is_due = false; !is_due;)
        occam::pri_alt(occam::when(client.from_router(), handed, [&] { cost("message_read"); }),
                       occam::after(due, [&] { is_due = true; }));
      Message message;
      message.to.processor = random.other_than(client.processor(), processors);
      message.length = bytes;
      cost("number_drawn");
      cost("number_drawn");
      cost("message_made");
      client.send(message);
    }
  }
};

Rows run(const Setup& setup) {
  const auto bytes = static_cast<std::uint64_t>(setup.whole("message_bytes"));
  const int n = setup.topology.processors;
  if (n < 2) throw base::BadInput("network.topology: found one processor, expected at least two");
  RouterMachine on(setup, network_params(setup, bytes));
  const ApplicationCost cost(setup.model);
  const Talk talk{cost, setup["pause_s"], bytes, static_cast<std::uint64_t>(setup.whole("seed")),
                  n};
  for (int id = 0; id < n; ++id)
    on.machine.processors()[id]->start(fmt::format("p{}.application", id), Priority::low,
                                       [&, id] { talk.run(on.network->client(id)); });
  run_machine_until(setup, on.machine, {setup["window_s"]});
  std::vector<Row> rows;
  for (int id = 0; id < n; ++id) {
    const auto& use = on.network->use(id);
    const double time_s = on.machine.now().value;
    rows.push_back(
        {{"processor", id},
         {"cpu_percent", 100 * (on.machine.processors()[id]->use().busy().value / time_s)},
         {"sent_per_s", static_cast<double>(use.taken) / time_s},
         {"received_per_s", static_cast<double>(use.delivered) / time_s},
         {"passed_per_s", static_cast<double>(use.passed) / time_s},
         {"most_held", static_cast<double>(use.most_held)}});
  }
  return Rows(std::move(rows));
}

}  // namespace

Pattern make_random_traffic() {
  return {.name = "random_traffic",
          .help =
              "messages of all processors to all others, at random: of each processor "
              "cpu_percent, of its router and of the application that makes them",
          .uses_topology = true,
          .parameters = router_parameters(
              {message_bytes_parameter(),
               {"pause_s", 1e-3, 1e-6, 1e6, false, "from a message to the next, on average"},
               {"window_s", 3, 1e-3, 1e5, false, "how long"},
               {"seed", 1, 0, 1e15, true, "of pauses and destinations"}}),
          .run = &run,
          .parts = {"processor"},
          .uses_routes = true};
}

}  // namespace programs
