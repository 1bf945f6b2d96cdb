// A processor with a router at high priority and a computation at low priority, which each message
// interrupts.
//
//   p0: sender ===> p1: router, and a computation ===> p2: receiver
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace interrupt {

struct Params {
  std::uint64_t bytes = 100;
  std::int64_t messages = 20;
  bool busy = true;
};

struct Measured {
  double latency_s = 0;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const auto messages = params.messages;
  Line machine(setup, 3);
  Seconds sum, sent;
  machine[0].start("sender", Priority::high, [&] {
    for (std::int64_t i = 0; i < messages; ++i) {
      // The next message is sent when the previous one has been handled. The interval is not a
      // round number, so that messages interrupt the computation at varying points.
      occam::wait_until(occam::ticks(START + static_cast<double>(i) * Seconds{1.237e-3}));
      sent = now();
      out(machine.channels[0], Message{params.bytes});
    }
  });
  machine[1].start("router", Priority::high, [&] {
    for (std::int64_t i = 0; i < messages; ++i) out(machine.channels[1], machine.channels[0].in());
  });
  if (params.busy)
    machine[1].start("computation", Priority::low, [&] {
      const Seconds enough = static_cast<double>(messages + 3) * Seconds{1.237e-3};
      compute({static_cast<std::int64_t>(enough.value * setup.model.cpu.clock.value)});
      this_process().sync();
    });
  machine[2].start("receiver", Priority::high, [&] {
    for (std::int64_t i = 0; i < messages; ++i) {
      machine.channels[1].in();
      sum += now() - sent;
    }
  });
  run_machine(setup, machine);
  return Measured{sum.value / static_cast<double>(messages)};
}

}  // namespace interrupt

Program make_interrupt() {
  using namespace interrupt;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "interrupt",
       .help = "a high-priority router beside a low-priority computation",
       .fields = {bytes_field<Params>(&Params::bytes),
                  D::whole("messages", &Params::messages, 1, 1e6, "",
                           "messages, one after the other"),
                  D::flag("busy", &Params::busy, "true: the router's processor also computes")},
       .columns = {column("latency_s", &Measured::latency_s,
                          "mean time of a message over the two links")},
       .run = &run});
}

}  // namespace programs
