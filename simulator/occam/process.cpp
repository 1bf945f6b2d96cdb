#include "simulator/occam/process.hpp"

#include <cmath>

#include "simulator/occam/channel.hpp"

namespace occam {

namespace {

Seconds tick_of(const Process& process, const machine::Model& model) {
  return {process.priority() == Priority::high ? model.timer.high_tick : model.timer.low_tick};
}

struct TimerWait : machine::Wait {
  std::string describe() const override { return "the timer"; }
};

// Number of ticks that are complete. A small tolerance keeps rounding errors from losing a tick.
std::int64_t whole_ticks(double ticks) {
  return static_cast<std::int64_t>(std::floor(ticks * (1 + 1e-12) + 1e-9));
}

// The state of a process that executes a PAR and waits until all branches have ended.
struct Join : machine::Wait {
  std::size_t running = 0;
  bool parent_waits = false;
  std::vector<const Process*> branches;

  std::string describe() const override { return "the end of its PAR branches"; }
  std::vector<machine::ProcessId> waits_for() const override {
    std::vector<machine::ProcessId> alive;
    for (const auto* branch : branches)
      if (branch->state() != Process::State::ended) alive.push_back(branch->id());
    return alive;
  }
};

}  // namespace

void par(std::span<const Branch> branches) {
  Process& self = this_process();
  machine::Processor& processor = self.processor();
  const auto& costs = processor.model().scheduler;
  Join join;
  join.running = branches.size();
  const Branch* own = nullptr;  // the branch that this process executes itself
  for (const Branch& branch : branches)
    if (branch.priority == self.priority()) own = &branch;
  charge(costs.par_setup);
  for (const Branch& branch : branches) {
    if (&branch == own) continue;
    charge(costs.par_branch +
           (branch.priority == self.priority() ? costs.start_process : costs.run_process));
    self.sync();
    const Process& started = processor.start(branch.name, branch.priority, [&, body = branch.body] {
      body();
      charge(costs.end_process);
      this_process().sync();
      this_process().end_by_this();
      if (--join.running == 0 && join.parent_waits)
        processor.make_ready(self, this_process().own_time());
    });
    join.branches.push_back(&started);
    self.sync();  // a branch with high priority may have taken the CPU
  }
  if (own) {
    own->body();
    --join.running;
  }
  charge(costs.end_process);
  self.sync();
  if (join.running > 0) {
    join.parent_waits = true;
    self.block(join);
  }
  for (const Process* branch : join.branches) processor.remove(*branch);
}

void par(std::initializer_list<Branch> branches) {
  par(std::span(branches.begin(), branches.size()));
}

bool turn(bool condition) {
  charge(this_process().processor().model().software.turn);
  return condition;
}

std::int64_t read_timer() {
  Process& self = this_process();
  const auto& model = self.processor().model();
  charge(model.timer.read);
  return whole_ticks(self.now() / tick_of(self, model));
}

Seconds date_of(const Process& process, std::int64_t tick) {
  return static_cast<double>(tick) * tick_of(process, process.processor().model());
}

void wait_until(std::int64_t tick) {
  Process& self = this_process();
  machine::Processor& processor = self.processor();
  const auto& model = processor.model();
  const Seconds date = date_of(self, tick);
  charge(self.own_time() >= date ? model.timer.wait_past : model.timer.wait_future);
  if (self.now() >= date) return;
  processor.wake_at(date, self, self.waits() + 1);
  TimerWait timer;
  self.block(timer);
}

std::int64_t ticks(Seconds duration) {
  Process& self = this_process();
  return std::llround(duration / tick_of(self, self.processor().model()));
}

}  // namespace occam
