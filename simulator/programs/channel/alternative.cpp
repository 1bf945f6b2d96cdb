// An ALT with n guards that waits for a single output.
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace alternative {

struct Params {
  std::uint64_t bytes = 100;
  int guards = 2, writer = 0;
};

struct Measured {
  Seconds latency, busy;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  Machine machine(setup, 1);
  auto& processor = machine[0];
  std::deque<Channel<Message>> channels;
  std::vector<occam::Guard> guards;
  for (int i = 0; i < params.guards; ++i)
    guards.emplace_back(&channels.emplace_back(fmt::format("guard{}", i)));
  Seconds sent, received;
  processor.start("reader", Priority::high, [&] {
    channels[occam::select(guards)].in();
    received = now();
  });
  processor.start("writer", Priority::high, [&] {
    wait_for_start();
    sent = now();
    out(channels[std::min(params.writer, params.guards - 1)], Message{params.bytes});
  });
  run_machine(setup, machine);
  return Measured{received - sent, processor.use().busy()};
}

}  // namespace alternative

Program make_alternative() {
  using namespace alternative;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "alternative",
       .help = "an ALT that waits on several guards, and an output to one of them",
       .fields = {bytes_field<Params>(&Params::bytes),
                  D::whole("guards", &Params::guards, 1, 1000, "",
                           "channels that the ALT waits on"),
                  D::whole("writer", &Params::writer, 0, 999, "",
                           "number of the guard that becomes ready, from 0; at most the last one")},
       .columns = {column("latency_s", &Measured::latency,
                          "from the start of out to the end of in"),
                   column("busy_s", &Measured::busy, "time that the CPU worked")},
       .run = &run});
}

}  // namespace programs
