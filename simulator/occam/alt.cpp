#include "simulator/occam/alt.hpp"

#include "simulator/occam/process.hpp"

namespace occam {

namespace {

using GuardKind = Guard::Kind;
using Costs = machine::Model::Alternative;

// True if the guard is ready. `date` returns the date to be used in the test; it is called only if
// needed.
template <class Date>
bool is_ready(const Process& self, const Guard& guard, Date date) {
  if (!guard.condition) return false;
  if (guard.kind == GuardKind::timer) return date() >= date_of(self, guard.tick);
  return guard.kind == GuardKind::skip ||
         (guard.channel->has_output() && guard.channel->output_waits(date()));
}

// The next two functions return the additional costs of a replicated guard: one step of its
// replicator, and the division that yields its index.
Cycles turn(const Costs& costs, const Guard& guard) {
  return guard.replicated ? costs.replicated : Cycles{};
}
Cycles modulo(const Costs& costs, const Guard& guard) {
  return guard.is_fair ? costs.modulo : Cycles{};
}

Cycles cost_to_enable(const Costs& costs, const Guard& guard, bool ready) {
  if (guard.kind == GuardKind::skip) return compiled(costs.enable_skip);
  if (guard.kind == GuardKind::timer) return compiled(costs.enable_timer);
  return compiled(turn(costs, guard) + (ready ? costs.enable_ready : costs.enable_not)) +
         modulo(costs, guard);
}

Cycles cost_to_disable(const Costs& costs, const Guard& guard) {
  if (guard.kind == GuardKind::skip) return compiled(costs.disable_skip);
  if (guard.kind == GuardKind::timer) return compiled(costs.disable_timer);
  return compiled(turn(costs, guard) + costs.disable) + modulo(costs, guard);
}

bool cost_the_same(const Guard& a, const Guard& b) {
  return a.kind == b.kind && a.replicated == b.replicated && a.is_fair == b.is_fair;
}

bool any_cut(std::span<const Guard> guards) {
  return std::ranges::any_of(guards, [](const Guard& g) { return g.channel && g.channel->cut(); });
}

}  // namespace

// Computes the cost of enabling and disabling all guards, as if none were ready. The additional
// costs of ready guards are charged later.
Select::Select(std::span<const Guard> guards) : guards_(guards) {
  const auto& costs = this_process().processor().model().alternative;
  const Guard* last = nullptr;
  Cycles enable{}, disable{};
  for (const Guard& guard : guards_) {
    looks_at_others_ |= guard.condition && guard.channel && guard.channel->joins_cpus();
    has_timer_ |= guard.kind == GuardKind::timer;
    if (!last || !cost_the_same(*last, guard)) {
      enable = cost_to_enable(costs, guard, false);
      disable = cost_to_disable(costs, guard);
    }
    enabling_ += enable;
    disabling_ += disable;
    last = &guard;
  }
  enabling_ += compiled(has_timer_ ? costs.timer_setup : costs.setup);
  disabling_ += compiled(costs.end);
}

std::string Select::describe() const {
  std::string names;
  for (const Guard& guard : guards_)
    if (guard.condition && guard.channel)
      names += (names.empty() ? "alt on " : ", ") + guard.channel->name() +
               (guard.channel->cut() ? " (link cut)" : "");
  return names;
}

std::vector<machine::ProcessId> Select::waits_for() const {
  std::vector<machine::ProcessId> writers;
  for (const Guard& guard : guards_)
    if (guard.condition && guard.channel && !guard.channel->cut() &&
        guard.channel->last_writer() != 0)
      writers.push_back(guard.channel->last_writer());
  return writers;
}

bool Select::go_on(Process& self) {
  switch (stage_) {
    case Stage::comes:
      for (const Guard& guard : guards_)
        if (guard.condition && guard.channel) guard.channel->take_input(self);
      stage_ = Stage::enables;
      // A small number of unpaid cycles is paid later, together with the cost of enabling the
      // guards.
      if (self.owes_much() && self.must_sync()) return false;
      [[fallthrough]];
    case Stage::enables:
      begin_ = self.own_time();
      cycle_ = self.processor().duration(Cycles{1});
      spend_enabling(self);
      if (some_ready(self)) return spend_wait(self, true);
      if (!must_settle(self)) return spend_wait(self, false);
      stage_ = Stage::enables_late;
      return false;
    case Stage::enables_late: {
      // All charged cycles have been paid by now, so enabling began span(enabled_) ago.
      cycle_ = self.paid_cycle();
      begin_ = self.own_time() - span(enabled_);
      const bool ready = some_ready(self);
      spend_enabling(self);
      return spend_wait(self, ready);
    }
    case Stage::waits:
      return wait(self);
    case Stage::has_waited:
      for (const Guard& guard : guards_)
        if (guard.condition && guard.channel) guard.channel->disable();
      return spend_disabling(self);
    case Stage::chooses:
      cycle_ = self.paid_cycle();
      from_ = self.own_time() - span(disabling_);
      return choose(self);
  }
  return true;
}

// True if the clock must reach the process's own time (Process::own_time) before the guards are
// tested. Before that date an output from another CPU may still arrive. Moreover, the own time may
// move to an earlier date than predicted, which may precede the tick of a timer guard.
bool Select::must_settle(const Process& self) const {
  return looks_at_others_ || has_timer_ ? self.must_sync() : self.must_sync_if_long();
}

// Called when the own time (Process::own_time) of a waiting process has moved: moves the dates at
// which the wait and the enabling of the guards began.
void Select::on_stretch(Process& process, const machine::Stretch& stretch) {
  const Seconds enabled_at = stretch(begin_ + span(enabled_));
  begin_ = stretch(begin_);
  if (enabled_.value > 0)
    cycle_ = {(enabled_at - begin_).value / static_cast<double>(enabled_.value)};
  for (const Guard& guard : guards_)
    if (guard.condition && guard.channel) guard.channel->move_enabling(process.blocked_since());
}

bool Select::some_ready(const Process& self) const {
  return std::ranges::any_of(guards_, [&](const Guard& guard) {
    return is_ready(self, guard, [&] { return self.own_time(); });
  });
}

// Cost of the instruction alt and of enabling all guards. Enabling costs a different number of
// cycles for a guard that is ready. An output that waits keeps waiting; hence, if no output waits
// at the end of enabling, none was waiting earlier.
Cycles Select::cost_to_enable_all(const Process& self) const {
  const auto waits = [&](const Guard& guard) {
    return guard.condition && guard.channel && guard.channel->has_output() &&
           guard.channel->output_waits(begin_ + span(enabling_));
  };
  if (std::ranges::none_of(guards_, waits)) return enabling_;
  const auto& costs = self.processor().model().alternative;
  Cycles spent = compiled(has_timer_ ? costs.timer_setup : costs.setup);
  for (const Guard& guard : guards_) {
    const auto turn = [&] { return begin_ + span(spent); };
    spent += cost_to_enable(costs, guard, is_ready(self, guard, turn));
  }
  return spent;
}

// Charges the cost of enabling the guards, as far as it is known. If an output arrives later but
// before the end of enabling, a later call charges the difference.
void Select::spend_enabling(Process& self) {
  const Cycles known = cost_to_enable_all(self);
  // The cost is lower than before because the link of a ready guard has been cut. Charged cycles
  // are not refunded.
  if (known < enabled_ && any_cut(guards_)) return;
  self.charge(Cycles{known.value - enabled_.value});
  enabled_ = known;
}

// Charges the instruction altwt or taltwt. If an output arrives while a high-priority process pays
// for this instruction, the output wakes the process.
bool Select::spend_wait(Process& self, bool ready) {
  const auto& costs = self.processor().model().alternative;
  if (has_timer_)
    charge(ready ? costs.timer_wait_ready : costs.timer_wait_not);
  else
    charge(ready ? costs.wait_ready : costs.wait_not);
  stage_ = Stage::waits;
  const bool must_pay = ready ? must_settle(self) : self.must_sync_if_long();
  return !must_pay && wait(self);
}

// Blocks until a guard whose condition is true may be ready.
bool Select::wait(Process& self) {
  if (some_ready(self)) return spend_disabling(self);
  bool some_open = false;
  for (const Guard& guard : guards_) {
    if (!guard.condition) continue;
    some_open = true;
    if (guard.channel) guard.channel->enable(self);
    if (guard.kind == Guard::Kind::timer)
      self.processor().wake_at(date_of(self, guard.tick), self, self.waits() + 1);
  }
  if (!some_open)
    throw machine::Misuse(self.name(), self.own_time(),
                          fmt::format("{} on {} is in an ALT without an open guard at {:.6f} s",
                                      self.name(), self.processor().name(), self.own_time().value));
  stage_ = Stage::has_waited;
  self.start_wait(*this);
  return false;
}

bool Select::spend_disabling(Process& self) {
  spend_enabling(self);
  from_ = self.own_time();
  cycle_ = self.processor().duration(Cycles{1});
  self.charge(disabling_);
  stage_ = Stage::chooses;
  return !must_settle(self) && choose(self);
}

// Disables the guards in order, and chooses the first guard that is ready at the time when it is
// disabled. If the link of the only ready guard has been cut meanwhile, waits again.
bool Select::choose(Process& self) {
  const auto& costs = self.processor().model().alternative;
  Cycles spent{};
  for (chosen_ = 0; chosen_ < guards_.size(); ++chosen_) {
    const Guard& guard = guards_[chosen_];
    spent += cost_to_disable(costs, guard);
    if (!is_ready(self, guard, [&] { return from_ + span(spent); })) continue;
    for (const Guard& each : guards_)
      if (each.condition && each.channel) each.channel->leave_input();
    return true;
  }
  if (!any_cut(guards_))
    throw base::InvariantBroken(self.name() + ": an ALT woke without a ready guard");
  return wait(self);
}

}  // namespace occam
