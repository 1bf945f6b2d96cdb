// A saturated pipeline: every stage inputs, computes, outputs.
#include "simulator/declare/support.hpp"

namespace programs {

namespace {

Row run(const Setup& setup) {
  const auto stages = static_cast<int>(setup.whole("stages"));
  const auto messages = setup.whole("messages");
  const Cycles work{setup.whole("stage_cycles")};
  machine::Machine machine(setup.model);
  Line line(machine, stages);
  std::vector<Seconds> arrivals;
  for (int id = 0; id < stages; ++id) {
    machine.processors()[id]->start("stage", Priority::high, [&, id] {
      for (std::int64_t i = 0; i < messages; ++i) {
        if (id > 0) line.channels[id - 1].in();
        if (id + 1 == stages) arrivals.push_back(now());
        compute(work);
        if (id + 1 < stages) out(line.channels[id], make_message_of(setup));
      }
    });
  }
  run_machine(setup, machine);
  // Of the second half, when the pipeline is full.
  const std::size_t half = arrivals.size() / 2;
  const Seconds took = arrivals.back() - arrivals[half];
  const double period = took.value / static_cast<double>(arrivals.size() - 1 - half);
  return {{"period_s", period}, {"throughput_per_s", 1 / period}, {"time_s", machine.now().value}};
}

}  // namespace

Pattern make_pipeline() {
  return {"pipeline",
          "a saturated pipeline of stages that input, compute and output: throughput_per_s",
          false,
          {bytes_parameter(1),
           {"stages", 4, 3, 1000, true, "processors in a line"},
           {"messages", 100, 4, 1e7, true, "that pass"},
           {"stage_cycles", 1000, 0, 1e9, true, "of computation in each stage, for each message"}},
          &run};
}

}  // namespace programs
