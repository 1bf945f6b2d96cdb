// Request and reply between two processors.
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace request {

struct Params {
  std::uint64_t bytes = 100, reply_bytes = 100;
  Cycles service_cycles{1000};
  std::int64_t rounds = 10;
};

struct Measured {
  double round_trip_s = 0;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const auto rounds = params.rounds;
  Machine machine(setup, 2);
  auto &client = machine[0], &server = machine[1];
  machine.connect(client, server);
  Channel<Message> request("server.in", machine.link(client, server)),
      reply("client.in", machine.link(server, client));
  Seconds took;
  client.start("client", Priority::high, [&] {
    wait_for_start();
    const Seconds from = now();
    for (std::int64_t i = 0; i < rounds; ++i) {
      out(request, Message{params.bytes});
      reply.in();
    }
    took = now() - from;
  });
  server.start("server", Priority::high, [&] {
    for (std::int64_t i = 0; i < rounds; ++i) {
      request.in();
      compute(params.service_cycles);
      out(reply, Message{params.reply_bytes});
    }
  });
  run_machine(setup, machine);
  return Measured{took.value / static_cast<double>(rounds)};
}

}  // namespace request

Program make_request() {
  using namespace request;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "request",
       .help = "requests to a neighbour, each with a reply",
       .fields = {bytes_field<Params>(&Params::bytes),
                  D::whole("reply_bytes", &Params::reply_bytes, 1, 1e9, "bytes",
                           "length of the reply"),
                  D::whole("service_cycles", &Params::service_cycles, 0, 1e9, "cycles",
                           "computation of the server for a request"),
                  D::whole("rounds", &Params::rounds, 1, 1e7, "", "requests, one after the other")},
       .columns = {column("round_trip_s", &Measured::round_trip_s,
                          "mean time from a request to the end of its reply")},
       .run = &run});
}

}  // namespace programs
