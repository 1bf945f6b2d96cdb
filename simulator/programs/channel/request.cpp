// Request and reply between two processors.
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

Row run(const Setup& setup) {
  const auto rounds = setup.whole("rounds");
  const Cycles service{setup.whole("service_cycles")};
  machine::Machine machine(setup.model);
  add_processors(machine, 2);
  auto &client = *machine.processors()[0], &server = *machine.processors()[1];
  machine.connect(client, server);
  Channel<Message> request("server.in", machine.link(client, server)),
      reply("client.in", machine.link(server, client));
  Seconds took;
  client.start("client", Priority::high, [&] {
    wait_for_start();
    const Seconds from = now();
    for (std::int64_t i = 0; i < rounds; ++i) {
      out(request, make_message_of(setup));
      reply.in();
    }
    took = now() - from;
  });
  server.start("server", Priority::high, [&] {
    for (std::int64_t i = 0; i < rounds; ++i) {
      request.in();
      compute(service);
      out(reply, Message{static_cast<std::uint64_t>(setup.whole("reply_bytes"))});
    }
  });
  run_machine(setup, machine);
  return {{"round_trip_s", took.value / static_cast<double>(rounds)}};
}

}  // namespace

Pattern make_request() {
  return {"request",
          "request and reply between neighbours: round_trip_s",
          false,
          {bytes_parameter(1),
           {"reply_bytes", 100, 1, 1e9, true, "length of the reply"},
           {"service_cycles", 1000, 0, 1e9, true, "of the server, for each request"},
           {"rounds", 10, 1, 1e7, true, "requests, one after the other"}},
          &run};
}

}  // namespace programs
