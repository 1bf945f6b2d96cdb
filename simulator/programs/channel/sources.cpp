// Parallel sources that share one link, and a relay behind it.
//
//   source 0 --.
//   source 1 ---+-> multiplexer ===> relay ===> sink
//   source k --'          p0           p1        p2
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

void multiplexer(std::span<Channel<Message>* const> inputs, Channel<Message>& output,
                 std::int64_t messages) {
  Message message;
  std::size_t favourite = 0;
  for (; messages > 0; --messages) {
    favourite = (occam::fair_alt(favourite, inputs, message) + 1) % inputs.size();
    out(output, message);
  }
}

Row run(const Setup& setup) {
  const auto k = setup.whole("sources"), each = setup.whole("messages");
  machine::Machine machine(setup.model);
  Line line(machine, 3);
  auto& from = *machine.processors()[0];
  std::deque<Channel<Message>> soft;
  std::vector<Channel<Message>*> inputs;
  for (std::int64_t i = 0; i < k; ++i) {
    inputs.push_back(&soft.emplace_back(fmt::format("from.source{}", i)));
    from.start(fmt::format("source{}", i), Priority::high, [&, channel = inputs.back()] {
      for (std::int64_t m = 0; m < each; ++m) out(*channel, make_message_of(setup));
    });
  }
  from.start("multiplexer", Priority::high,
             [&] { multiplexer(inputs, line.channels[0], k * each); });
  machine.processors()[1]->start("relay", Priority::high, [&] {
    for (std::int64_t m = 0; m < k * each; ++m) out(line.channels[1], line.channels[0].in());
  });
  std::vector<Seconds> arrivals;
  machine.processors()[2]->start("sink", Priority::high, [&] {
    for (std::int64_t m = 0; m < k * each; ++m) {
      line.channels[1].in();
      arrivals.push_back(now());
    }
  });
  run_machine(setup, machine);
  // In the middle half, when every source still has something to say.
  const std::size_t n = arrivals.size(), a = n / 4, b = n - 1 - n / 4;
  const double period = (arrivals[b] - arrivals[a]).value / static_cast<double>(b - a);
  return {{"period_s", period},
          {"period_of_a_source_s", static_cast<double>(k) * period},
          {"time_s", machine.now().value}};
}

}  // namespace

Pattern make_sources() {
  return {"sources",
          "parallel sources through one link and a relay: period_s, between messages",
          false,
          {bytes_parameter(1),
           {"sources", 2, 1, static_cast<double>(occam::MAX_REPLICAS), true, "processes that send"},
           {"messages", 40, 4, 1e7, true, "of each source"}},
          &run};
}

}  // namespace programs
