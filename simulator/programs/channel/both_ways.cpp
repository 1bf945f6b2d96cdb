// Messages in both directions of one link at once.
//
//   p0: sender --->  p1: receiver
//   p0: receiver <--- p1: sender
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

Row run(const Setup& setup) {
  machine::Machine machine(setup.model);
  add_processors(machine, 2);
  const auto messages = setup.whole("messages");
  const bool both = setup["both"] != 0;
  std::deque<Channel<Message>> channels;
  machine.connect(*machine.processors()[0], *machine.processors()[1]);
  for (int from : {0, 1}) {
    if (from == 1 && !both) break;
    auto &here = *machine.processors()[from], &there = *machine.processors()[1 - from];
    auto& channel = channels.emplace_back(there.name() + ".in", machine.link(here, there));
    here.start("sender", Priority::high, [&] {
      for (std::int64_t i = 0; i < messages; ++i) out(channel, make_message_of(setup));
    });
    there.start("receiver", Priority::high, [&] {
      for (std::int64_t i = 0; i < messages; ++i) channel.in();
    });
  }
  run_machine(setup, machine);
  const double bytes = static_cast<double>(messages) * setup["bytes"] * (both ? 2 : 1);
  return {{"time_s", machine.now().value}, {"rate_Bps", bytes / machine.now().value}};
}

}  // namespace

Pattern make_both_ways() {
  return {"both_ways",
          "messages over one link, in one direction or both at once: rate_Bps, of all together",
          false,
          {bytes_parameter(1),
           {"messages", 100, 1, 1e7, true, "in each direction"},
           {"both", 1, 0, 1, true, "both directions, 1, or one, 0"}},
          &run};
}

}  // namespace programs
