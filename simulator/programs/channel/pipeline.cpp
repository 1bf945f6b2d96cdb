// A full pipeline. Every stage inputs, computes and outputs.
#include "simulator/programs/declare/support.hpp"

namespace programs {

namespace pipeline {

struct Params {
  std::uint64_t bytes = 100;
  int stages = 4;
  std::int64_t messages = 100;
  Cycles stage_cycles{1000};
};

struct Measured {
  double period_s = 0;
  Seconds time;
};

Outcome<Measured> run(const Setup& setup, const Params& params) {
  const int stages = params.stages;
  Line machine(setup, stages);
  std::vector<Seconds> arrivals;
  for (int id = 0; id < stages; ++id) {
    machine[id].start("stage", Priority::high, [&, id] {
      for (std::int64_t i = 0; i < params.messages; ++i) {
        if (id > 0) machine.channels[id - 1].in();
        if (id + 1 == stages) arrivals.push_back(now());
        compute(params.stage_cycles);
        if (id + 1 < stages) out(machine.channels[id], Message{params.bytes});
      }
    });
  }
  run_machine(setup, machine);
  // Measures only the second half of the messages, during which the pipeline is full.
  const std::size_t half = arrivals.size() / 2;
  const Seconds took = arrivals.back() - arrivals[half];
  const double period = took.value / static_cast<double>(arrivals.size() - 1 - half);
  return Measured{period, machine.now()};
}

}  // namespace pipeline

Program make_pipeline() {
  using namespace pipeline;
  using D = base::Declare<Params>;
  return make_program<Params, Measured>(
      {.name = "pipeline",
       .help = "a saturated pipeline of stages that input, compute and output",
       .fields = {bytes_field<Params>(&Params::bytes),
                  D::whole("stages", &Params::stages, 3, 1000, "", "processors in a line"),
                  D::whole("messages", &Params::messages, 4, 1e7, "",
                           "messages through the pipeline"),
                  D::whole("stage_cycles", &Params::stage_cycles, 0, 1e9, "cycles",
                           "computation of a stage for a message")},
       .columns = {column("period_s", &Measured::period_s, "mean time between two messages"),
                   column<Measured>(
                       "throughput_per_s", [](const Measured& m) { return 1 / m.period_s; },
                       "messages a second"),
                   column("time_s", &Measured::time, "time until all messages have passed")},
       .run = &run});
}

}  // namespace programs
