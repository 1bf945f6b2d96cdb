// A router at high priority on a processor that computes at low priority.
//
//   p0: sender ===> p1: router, and a computation ===> p2: receiver
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

Row run(const Setup& setup) {
  const bool busy = setup["busy"] != 0;
  const auto messages = setup.whole("messages");
  machine::Machine machine(setup.model);
  Line line(machine, 3);
  Seconds sum, sent;
  machine.processors()[0]->start("sender", Priority::high, [&] {
    for (std::int64_t i = 0; i < messages; ++i) {
      // Far enough apart for the machine to be idle; odd, to meet the computation anywhere.
      occam::wait_until(occam::ticks(START + static_cast<double>(i) * Seconds{1.237e-3}));
      sent = now();
      out(line.channels[0], make_message_of(setup));
    }
  });
  machine.processors()[1]->start("router", Priority::high, [&] {
    for (std::int64_t i = 0; i < messages; ++i) out(line.channels[1], line.channels[0].in());
  });
  if (busy)
    machine.processors()[1]->start("computation", Priority::low, [&] {
      const Seconds enough = static_cast<double>(messages + 3) * Seconds{1.237e-3};
      compute({static_cast<std::int64_t>(enough.value * setup.model.cpu.clock.value)});
      this_process().sync();
    });
  machine.processors()[2]->start("receiver", Priority::high, [&] {
    for (std::int64_t i = 0; i < messages; ++i) {
      line.channels[1].in();
      sum += now() - sent;
    }
  });
  run_machine(setup, machine);
  return {{"latency_s", sum.value / static_cast<double>(messages)}};
}

}  // namespace

Pattern make_interrupt() {
  return {"interrupt",
          "a high-priority router beside a low-priority computation: latency_s, over two links",
          false,
          {bytes_parameter(1),
           {"messages", 20, 1, 1e6, true, "one after the other"},
           {"busy", 1, 0, 1, true, "the router's processor computes, 1, or is idle, 0"}},
          &run};
}

}  // namespace programs
