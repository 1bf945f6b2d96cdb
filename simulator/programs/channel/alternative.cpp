// An ALT over n guards, none ready, and one output.
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

Row run(const Setup& setup) {
  const auto n = setup.whole("guards"), writer = setup.whole("writer");
  machine::Machine machine(setup.model);
  add_processors(machine, 1);
  auto& processor = *machine.processors()[0];
  std::deque<Channel<Message>> channels;
  std::vector<occam::Guard> guards;
  for (std::int64_t i = 0; i < n; ++i)
    guards.emplace_back(&channels.emplace_back(fmt::format("guard{}", i)));
  Seconds sent, received;
  processor.start("reader", Priority::high, [&] {
    channels[occam::select(guards)].in();
    received = now();
  });
  processor.start("writer", Priority::high, [&] {
    wait_for_start();
    sent = now();
    out(channels[static_cast<std::size_t>(std::min(writer, n - 1))], make_message_of(setup));
  });
  run_machine(setup, machine);
  return {{"latency_s", (received - sent).value}, {"busy_s", processor.use().busy().value}};
}

}  // namespace

Pattern make_alternative() {
  return {"alternative",
          "an ALT that waits over n guards, and an output: latency_s, from out to the end of in; "
          "busy_s, of the CPU in all",
          false,
          {bytes_parameter(1),
           {"guards", 2, 1, 1000, true, "channels the ALT waits on"},
           {"writer", 0, 0, 999, true, "the guard that becomes ready, from 0"}},
          &run};
}

}  // namespace programs
