// One message over one link: what channel communication between two processors takes.
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

Row run(const Setup& setup) {
  machine::Machine machine(setup.model);
  add_processors(machine, 2);
  auto &left = *machine.processors()[0], &right = *machine.processors()[1];
  machine.connect(left, right, static_cast<int>(setup.whole("switches")));
  Channel<Message> channel("right.in", machine.link(left, right));
  Seconds sent, received;
  left.start("sender", Priority::high, [&] {
    wait_for_start();
    sent = now();
    out(channel, make_message_of(setup));
  });
  right.start("receiver", Priority::high, [&] {
    Message message;
    in(channel, message);
    received = now();
  });
  run_machine(setup, machine);
  return {{"latency_s", (received - sent).value}};
}

}  // namespace

Pattern make_message() {
  return {"message",
          "one message over one link, its receiver waiting: latency_s, from out to in",
          false,
          {bytes_parameter(0),
           {"switches", 0, 0, 16, true, "C004 link switches between the two processors"}},
          &run};
}

}  // namespace programs
