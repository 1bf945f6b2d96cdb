// Messages in both directions of one link at the same time.
//
//   p0: sender --->  p1: receiver
//   p0: receiver <--- p1: sender
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace both_ways {

struct Params {
  std::uint64_t bytes = 100;
  std::int64_t messages = 100;
  bool both = true;
};

struct Measured {
  Seconds time;
  double rate_Bps = 0;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  Machine machine(setup, 2);
  std::deque<Channel<Message>> channels;
  machine.connect(machine[0], machine[1]);
  for (int from : {0, 1}) {
    if (from == 1 && !params.both) break;
    auto &here = machine[from], &there = machine[1 - from];
    auto& channel = channels.emplace_back(there.name() + ".in", machine.link(here, there));
    here.start("sender", Priority::high, [&] {
      for (std::int64_t i = 0; i < params.messages; ++i) out(channel, Message{params.bytes});
    });
    there.start("receiver", Priority::high, [&] {
      for (std::int64_t i = 0; i < params.messages; ++i) channel.in();
    });
  }
  run_machine(setup, machine);
  const double bytes = static_cast<double>(params.messages) * static_cast<double>(params.bytes) *
                       (params.both ? 2 : 1);
  return Measured{machine.now(), bytes / machine.now().value};
}

}  // namespace both_ways

Program make_both_ways() {
  using namespace both_ways;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "both_ways",
       .help = "messages over one link, in one direction or in both at once",
       .fields = {bytes_field<Params>(&Params::bytes),
                  D::whole("messages", &Params::messages, 1, 1e7, "", "messages in each direction"),
                  D::flag("both", &Params::both, "true: messages go in both directions")},
       .columns = {column("time_s", &Measured::time, "time until all messages have been received"),
                   column("rate_Bps", &Measured::rate_Bps,
                          "bytes a second of both directions together")},
       .run = &run});
}

}  // namespace programs
