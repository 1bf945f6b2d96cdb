// Random messages from every processor. Measures the CPU time of the routers and of the
// applications that send the messages (thesis, table 5.2).
#include "base/random.hpp"
#include "simulator/programs/declare/routers.hpp"

namespace programs {

namespace random_traffic {

using network::Client;

struct Params {
  RouterParams routers;
  std::uint64_t bytes = 4, seed = 1;
  double pause_s = 1e-3, window_s = 3;
};

struct Talk {
  const Params& params;
  int processors;

  // Body of the only application process of a processor. It receives messages until it must send
  // the next one.
  void run(Client& client) const {
    base::Random random(params.seed, client.processor());
    network::Handed handed;
    for (;;) {
      const auto due = occam::ticks(now() + Seconds{params.pause_s * random.exponential()});
      for (bool is_due = false; !is_due;)
        occam::pri_alt(occam::when(client.from_router(), handed, [&] { compute("message_read"); }),
                       occam::after(due, [&] { is_due = true; }));
      const int to = random.other_than(client.processor(), processors);
      for (const char* operation : {"number_drawn", "number_drawn", "message_made"})
        compute(operation);
      client.send({.to = {to}, .length = params.bytes});
    }
  }
};

struct Measured {
  base::Cell processor;
  double cpu_percent = 0, sent_per_s = 0, received_per_s = 0, passed_per_s = 0;
  std::size_t most_held = 0;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const int n = setup.topology.processors;
  check_two_processors(setup);
  RouterMachine on(setup, network_params(params.routers, params.bytes));
  const Talk talk{params, n};
  on.start_all([&](Client& client) { talk.run(client); });
  run_machine_until(setup, on, {params.window_s}, on.view());
  const double time_s = on.now().value;
  std::vector<Measured> rows;
  for (int id = 0; id < n; ++id) {
    const auto& use = on.network->use(id);
    const double taken_s = on[id].use().taken().value;
    rows.push_back({processor_cell(setup.topology, id), 100 * (taken_s / time_s),
                    static_cast<double>(use.taken) / time_s,
                    static_cast<double>(use.delivered) / time_s,
                    static_cast<double>(use.passed) / time_s, use.most_held});
  }
  return Outcome<Measured>(std::move(rows));
}

}  // namespace random_traffic

Program make_random_traffic() {
  using namespace random_traffic;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "random_traffic",
       .help = "random messages of all processors to all others",
       .uses = {.network = true, .routes = true, .others = true, .threads = true},
       .fields = with_routers<Params>(
           {message_bytes_field<Params>(&Params::bytes),
            D::number("pause_s", &Params::pause_s, 1e-6, 1e6, "s",
                      "mean time between two messages of a sender"),
            D::number("window_s", &Params::window_s, 1e-3, 1e5, "s", "simulated time"),
            seed_field<Params>(&Params::seed, "seed for pauses and destinations")}),
       .columns = {column("processor", &Measured::processor, "number or label"),
                   column("cpu_percent", &Measured::cpu_percent,
                          "percentage of the CPU's time used by the router, the application that "
                          "sends messages, and the DMA of links"),
                   column("sent_per_s", &Measured::sent_per_s,
                          "messages per second that its application sent"),
                   column("received_per_s", &Measured::received_per_s,
                          "messages per second that its application received"),
                   column("passed_per_s", &Measured::passed_per_s,
                          "messages per second that it forwarded from one link to another"),
                   most_held_column(&Measured::most_held)},
       .parts = {"processor"},
       .run = &run});
}

}  // namespace programs
