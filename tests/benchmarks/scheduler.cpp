#include "simulator/occam/channel.hpp"
#include "simulator/occam/process.hpp"
#include "tests/benchmarks/machine.hpp"
#include "tests/benchmarks/raw_simgrid.hpp"

namespace benchmarks {

using machine::Machine;
using machine::Priority;
using occam::Signal;
using occam::this_process;

namespace {

constexpr int MEETINGS = 200'000, PREEMPTIONS = 50'000;
constexpr std::int64_t PERIOD_US = 100;  // time between two pre-emptions
constexpr machine::Cycles INTERRUPTION{1000};

Sample rendezvous(machine::EngineParams engine) {
  Machine machine(model(), machine::Code::bare, engine);
  auto& processor = machine.add_processor("p", PROCESSOR_MEMORY);
  occam::Channel<Signal> channel("channel");
  processor.start("out", Priority::high, [&] {
    for (int i = 0; i < MEETINGS; ++i) out(channel, Signal{});
  });
  processor.start("in", Priority::high, [&] {
    for (int i = 0; i < MEETINGS; ++i) in(channel);
  });
  return run(machine, MEETINGS);
}

Sample preemptions(machine::EngineParams engine) {
  Machine machine(model(), machine::Code::bare, engine);
  auto& processor = machine.add_processor("p", PROCESSOR_MEMORY);
  processor.start("low", Priority::low, [&] {
    const auto period = static_cast<std::int64_t>(model().cpu.clock.value * 1e-6) * PERIOD_US;
    this_process().charge(occam::Cycles{period * PREEMPTIONS});
    this_process().sync();
  });
  processor.start("high", Priority::high, [] {
    for (int i = 1; i <= PREEMPTIONS; ++i) {
      occam::wait_until(i * PERIOD_US);
      this_process().charge(INTERRUPTION);
    }
  });
  Sample sample = run(machine, 0);
  sample.count = processor.use().preemptions;
  return sample;
}

}  // namespace

void add_scheduler() {
  add_on_all("soft-channel rendezvous", rendezvous);
  add_simulation("soft-channel rendezvous", "simgrid",
                 [] { return raw_rendezvous(model(), MEETINGS); });
  add_on_all("pre-emptions", preemptions);
  add_simulation("pre-emptions", "simgrid", [] {
    return raw_preemptions(model(), PREEMPTIONS, 1e-6 * PERIOD_US,
                           static_cast<double>(INTERRUPTION.value));
  });
}

}  // namespace benchmarks
