// One message on a soft channel: two processes of one processor.
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

Row run(const Setup& setup) {
  machine::Machine machine(setup.model);
  add_processors(machine, 1);
  auto& processor = *machine.processors()[0];
  const Priority priority = setup["high"] != 0 ? Priority::high : Priority::low;
  const bool reader_first = setup["reader_first"] != 0;
  Channel<Message> channel("soft");
  Seconds second_came, over;
  auto meet = [&](bool reads, bool is_second) {
    if (is_second) {
      wait_for_start();
      this_process().sync();
      second_came = now();
    }
    if (reads)
      channel.in();
    else
      out(channel, make_message_of(setup));
    if (is_second) over = now();
  };
  processor.start("writer", priority, [&] { meet(false, reader_first); });
  processor.start("reader", priority, [&] { meet(true, !reader_first); });
  run_machine(setup, machine);
  return {{"latency_s", (over - second_came).value}, {"busy_s", processor.use().busy().value}};
}

}  // namespace

Pattern make_soft() {
  return {"soft",
          "one message between two processes of a processor: latency_s, of the second to come",
          false,
          {bytes_parameter(1),
           {"reader_first", 1, 0, 1, true, "who comes first: the reader, 1, or the writer, 0"},
           {"high", 1, 0, 1, true, "priority of both: high, 1, or low, 0"}},
          &run};
}

}  // namespace programs
