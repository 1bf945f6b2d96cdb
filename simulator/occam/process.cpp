#include "simulator/occam/process.hpp"

#include <cmath>

#include "simulator/occam/channel.hpp"

namespace occam {

namespace {

Seconds tick_of(const Process& process, const machine::Model& model) {
  return {process.priority() == Priority::high ? model.timer.high_tick : model.timer.low_tick};
}

struct Reason : machine::Wait {
  explicit Reason(const char* text) : text(text) {}
  std::string describe() const override { return text; }
  const char* text;
};

// Whole ticks up to a time; a hair is added lest rounding lose one.
std::int64_t whole_ticks(double ticks) {
  return static_cast<std::int64_t>(std::floor(ticks * (1 + 1e-12) + 1e-9));
}

}  // namespace

void par(std::initializer_list<Branch> branches) {
  Process& self = this_process();
  machine::Processor& processor = self.processor();
  const auto& costs = processor.model().scheduler;
  std::size_t running = branches.size();
  bool waits = false;
  for (const Branch& branch : branches) {
    charge(costs.start_process);
    self.sync();
    processor.start(branch.name, branch.priority, [&, body = branch.body] {
      body();
      charge(costs.end_process);
      this_process().sync();
      if (--running == 0 && waits) processor.make_ready(self, this_process().now());
    });
  }
  charge(costs.end_process);
  self.sync();
  if (running == 0) return;
  waits = true;
  self.block(Reason("the end of its PAR branches"));
}

std::int64_t read_timer() {
  Process& self = this_process();
  const auto& model = self.processor().model();
  charge(model.timer.read);
  self.sync();
  return whole_ticks(self.now() / tick_of(self, model));
}

void wait_until(std::int64_t tick) {
  Process& self = this_process();
  machine::Processor& processor = self.processor();
  const auto& model = processor.model();
  const Seconds date = static_cast<double>(tick) * tick_of(self, model);
  charge(self.now() >= date ? model.timer.wait_past : model.timer.wait_future);
  self.sync();
  if (self.now() >= date) return;
  processor.engine().at(date, [&processor, &self, date] { processor.make_ready(self, date); });
  self.block(Reason("the timer"));
}

std::int64_t ticks(Seconds duration) {
  Process& self = this_process();
  return std::llround(duration / tick_of(self, self.processor().model()));
}

}  // namespace occam
