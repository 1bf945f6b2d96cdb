// A ring of processes that deadlocks. In the first round, every second process inputs before it
// outputs, and the round succeeds. In the second round, all processes output first, and wait for
// each other.
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace deadlock {

struct Params {
  std::uint64_t bytes = 100;
  int stations = 4;
};

struct Measured {
  Seconds time;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const int n = params.stations;
  Machine machine(setup, n);
  std::deque<Channel<Message>> channels;
  for (int id = 0; id < n; ++id) machine.connect(machine[id], machine[(id + 1) % n]);
  for (int id = 0; id < n; ++id) {
    auto& next = machine[(id + 1) % n];
    channels.emplace_back(next.name() + ".in", machine.link(machine[id], next));
  }
  for (int id = 0; id < n; ++id)
    machine[id].start(fmt::format("p{}.station", id), Priority::high, [&, id] {
      auto &from = channels[(id + n - 1) % n], &to = channels[id];
      const bool inputs_first = id % 2 == 1;
      if (inputs_first) from.in();
      out(to, Message{params.bytes});
      if (!inputs_first) from.in();
      out(to, Message{params.bytes});
      from.in();
    });
  run_machine(setup, machine);
  return Measured{machine.now()};
}

}  // namespace deadlock

Program make_deadlock() {
  using namespace deadlock;
  return make_program<Params, Measured>(
      {.name = "deadlock",
       .help = "a ring whose first round succeeds; in the second all processes output first, to "
               "show the report of a deadlock",
       .fields = {bytes_field<Params>(&Params::bytes),
                  base::Declare<Params>::whole("stations", &Params::stations, 3, 1000, "",
                                               "processors in the ring")},
       .columns = {column("time_s", &Measured::time,
                          "always empty, because the run does not complete")},
       .run = &run});
}

}  // namespace programs
