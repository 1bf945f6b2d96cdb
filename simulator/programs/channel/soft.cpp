// A single message on a soft channel between two processes of a processor.
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace soft {

struct Params {
  std::uint64_t bytes = 100;
  bool reader_first = true, high = true;
};

struct Measured {
  Seconds latency, busy;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  Machine machine(setup, 1);
  auto& processor = machine[0];
  const Priority priority = params.high ? Priority::high : Priority::low;
  Channel<Message> channel("soft");
  Seconds second_came, over;
  auto meet = [&](bool reads, bool is_second) {
    if (is_second) {
      wait_for_start();
      second_came = now();
    }
    if (reads)
      channel.in();
    else
      out(channel, Message{params.bytes});
    if (is_second) over = now();
  };
  processor.start("writer", priority, [&] { meet(false, params.reader_first); });
  processor.start("reader", priority, [&] { meet(true, !params.reader_first); });
  run_machine(setup, machine);
  return Measured{over - second_came, processor.use().busy()};
}

}  // namespace soft

Program make_soft() {
  using namespace soft;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "soft",
       .help = "one message between two processes on one processor",
       .fields = {bytes_field<Params>(&Params::bytes),
                  D::flag("reader_first", &Params::reader_first,
                          "true: the reader arrives first; false: the writer"),
                  D::flag("high", &Params::high,
                          "true: both processes have high priority; false: low")},
       .columns = {column("latency_s", &Measured::latency,
                          "time that the process arriving second spends in its in or out"),
                   column("busy_s", &Measured::busy, "time that the CPU worked")},
       .run = &run});
}

}  // namespace programs
