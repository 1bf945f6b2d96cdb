// A ring of processes that deadlocks: in the first round every second one inputs before it outputs,
// in the second all output first, and each waits for its neighbour.
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

Row run(const Setup& setup) {
  const auto n = static_cast<int>(setup.whole("stations"));
  machine::Machine machine(setup.model);
  add_processors(machine, n);
  std::deque<Channel<Message>> channels;
  for (int id = 0; id < n; ++id)
    machine.connect(*machine.processors()[id], *machine.processors()[(id + 1) % n]);
  for (int id = 0; id < n; ++id) {
    auto& next = *machine.processors()[(id + 1) % n];
    channels.emplace_back(next.name() + ".in", machine.link(*machine.processors()[id], next));
  }
  for (int id = 0; id < n; ++id)
    machine.processors()[id]->start(fmt::format("p{}.station", id), Priority::high, [&, id] {
      auto &from = channels[(id + n - 1) % n], &to = channels[id];
      const bool inputs_first = id % 2 == 1;
      if (inputs_first) from.in();
      out(to, make_message_of(setup));
      if (!inputs_first) from.in();
      out(to, make_message_of(setup));
      from.in();
    });
  run_machine(setup, machine);
  return {{"time_s", machine.now().value}};
}

}  // namespace

Pattern make_deadlock() {
  return {"deadlock",
          "a ring whose processes all output first, to show what is said of a deadlock",
          false,
          {bytes_parameter(), {"stations", 4, 3, 1000, true, "processors in the ring"}},
          &run};
}

}  // namespace programs
