// Parallel sources that share one link, and a relay behind it.
//
//   source 0 --.
//   source 1 ---+-> multiplexer ===> relay ===> sink
//   source k --'          p0           p1        p2
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace sources {

void multiplexer(std::span<Channel<Message>* const> inputs, Channel<Message>& output,
                 std::int64_t messages) {
  Message message;
  std::size_t favourite = 0;
  for (; messages > 0; --messages) {
    favourite = (occam::fair_alt(favourite, inputs, message) + 1) % inputs.size();
    out(output, message);
  }
}

struct Params {
  std::uint64_t bytes = 100;
  std::int64_t sources = 2, messages = 40;
};

struct Measured {
  double period_s = 0, period_of_a_source_s = 0;
  Seconds time;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const auto k = params.sources, all = k * params.messages;
  Line machine(setup, 3);
  auto& from = machine[0];
  std::deque<Channel<Message>> soft;
  std::vector<Channel<Message>*> inputs;
  for (std::int64_t i = 0; i < k; ++i) {
    inputs.push_back(&soft.emplace_back(fmt::format("from.source{}", i)));
    from.start(fmt::format("source{}", i), Priority::high, [&, channel = inputs.back()] {
      for (std::int64_t m = 0; m < params.messages; ++m) out(*channel, Message{params.bytes});
    });
  }
  from.start("multiplexer", Priority::high, [&] { multiplexer(inputs, machine.channels[0], all); });
  machine[1].start("relay", Priority::high, [&] {
    for (std::int64_t m = 0; m < all; ++m) out(machine.channels[1], machine.channels[0].in());
  });
  std::vector<Seconds> arrivals;
  machine[2].start("sink", Priority::high, [&] {
    for (std::int64_t m = 0; m < all; ++m) {
      machine.channels[1].in();
      arrivals.push_back(now());
    }
  });
  run_machine(setup, machine);
  // Measures the middle half of the messages, during which all sources still have messages to send.
  const std::size_t n = arrivals.size(), a = n / 4, b = n - 1 - n / 4;
  const double period = (arrivals[b] - arrivals[a]).value / static_cast<double>(b - a);
  return Measured{period, static_cast<double>(k) * period, machine.now()};
}

}  // namespace sources

Program make_sources() {
  using namespace sources;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "sources",
       .help = "parallel sources that share one link, and a relay behind it",
       .fields = {bytes_field<Params>(&Params::bytes),
                  D::whole("sources", &Params::sources, 1, 8, "", "processes that send"),
                  D::whole("messages", &Params::messages, 4, 1e7, "", "messages of each source")},
       .columns = {column("period_s", &Measured::period_s,
                          "mean time between two messages at the sink"),
                   column("period_of_a_source_s", &Measured::period_of_a_source_s,
                          "mean time between two messages of one source at the sink"),
                   column("time_s", &Measured::time, "time until all messages have arrived")},
       .run = &run});
}

}  // namespace programs
