#include <deque>

#include "simulator/occam/channel.hpp"
#include "tests/benchmarks/machine.hpp"
#include "tests/benchmarks/raw_simgrid.hpp"

namespace benchmarks {

using machine::Machine;
using machine::Priority;

namespace {

struct Message {
  static constexpr std::uint64_t bytes() { return MESSAGE_BYTES; }
};
using Channel = occam::Channel<Message>;

void relay(Channel* before, Channel* after) {
  Message message;
  for (int i = 0; i < LINE_MESSAGES; ++i) {
    if (before) in(*before, message);
    if (after) out(*after, message);
  }
}

// A line of processors. Each processor except the last sends to the next one, and each except the
// first receives.
Sample line(machine::EngineParams engine) {
  Machine machine(model(), machine::Code::bare, engine);
  std::deque<Channel> channels;
  const auto& processors = machine.processors();
  for (int id = 0; id <= LINE_HOPS; ++id)
    machine.add_processor(fmt::format("p{}", id), PROCESSOR_MEMORY);
  for (int id = 0; id < LINE_HOPS; ++id) {
    machine.connect(*processors[id], *processors[id + 1]);
    channels.emplace_back("channel", machine.link(*processors[id], *processors[id + 1]));
  }
  for (int id = 0; id <= LINE_HOPS; ++id)
    processors[id]->start("relay", Priority::high, [&, id] {
      relay(id > 0 ? &channels[id - 1] : nullptr, id < LINE_HOPS ? &channels[id] : nullptr);
    });
  return run(machine, std::uint64_t{LINE_MESSAGES} * LINE_HOPS);
}

}  // namespace

void add_line() {
  add_on_all("hops of 80 bytes, line of 4", line);
  add_simulation("hops of 80 bytes, line of 4", "simgrid", [] { return raw_line(model()); });
}

}  // namespace benchmarks
