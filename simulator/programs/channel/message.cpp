// A single message over a link. Measures the time of communication between two processors.
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace message {

struct Params {
  std::uint64_t bytes = 100;
  int switches = 0;
};

struct Measured {
  Seconds latency;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  Machine machine(setup, 2);
  auto &left = machine[0], &right = machine[1];
  machine.connect(left, right, params.switches);
  Channel<Message> channel("right.in", machine.link(left, right));
  Seconds sent, received;
  left.start("sender", Priority::high, [&] {
    wait_for_start();
    sent = now();
    out(channel, Message{params.bytes});
  });
  right.start("receiver", Priority::high, [&] {
    Message message;
    in(channel, message);
    received = now();
  });
  run_machine(setup, machine);
  return Measured{received - sent};
}

}  // namespace message

Program make_message() {
  using namespace message;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "message",
       .help = "one message over one link to a waiting receiver",
       .fields = {bytes_field<Params>(&Params::bytes, 0),
                  D::whole("switches", &Params::switches, 0, 16, "",
                           "C004 link switches between the two processors")},
       .columns = {column("latency_s", &Measured::latency,
                          "from the start of out to the end of in")},
       .run = &run});
}

}  // namespace programs
