#include "simulator/occam/alt.hpp"

#include "simulator/occam/process.hpp"

namespace occam {

namespace {

using Kind = Guard::Kind;
using Costs = machine::Model::Alternative;

// `date` tells when: it is asked only where that matters.
template <class Date>
bool is_ready(const Process& self, const Guard& guard, Date date) {
  if (!guard.condition) return false;
  if (guard.kind == Kind::timer) return date() >= date_of(self, guard.tick);
  return guard.kind == Kind::skip ||
         (guard.channel->has_output() && guard.channel->output_waits(date()));
}

Cycles cost_to_enable(const Costs& costs, const Guard& guard, bool ready) {
  if (guard.kind == Kind::skip) return compiled(costs.enable_skip);
  if (guard.kind == Kind::timer) return compiled(costs.enable_timer);
  return compiled(guard.turn + (ready ? costs.enable_ready : costs.enable_not)) + guard.modulo;
}

Cycles cost_to_disable(const Costs& costs, const Guard& guard) {
  if (guard.kind == Kind::skip) return compiled(costs.disable_skip);
  if (guard.kind == Kind::timer) return compiled(costs.disable_timer);
  return compiled(guard.turn + costs.disable) + guard.modulo;
}

bool has_timer(std::span<const Guard> guards) {
  return std::ranges::any_of(guards, [](const Guard& g) { return g.kind == Kind::timer; });
}

bool any_cut(std::span<const Guard> guards) {
  return std::ranges::any_of(guards, [](const Guard& g) { return g.channel && g.channel->cut(); });
}

struct AltWait : machine::Wait {
  explicit AltWait(std::span<const Guard> guards) : guards(guards) {}
  std::string describe() const override {
    std::string names;
    for (const Guard& guard : guards)
      if (guard.condition && guard.channel)
        names += (names.empty() ? "alt on " : ", ") + guard.channel->name() +
                 (guard.channel->cut() ? " (link cut)" : "");
    return names;
  }
  std::vector<machine::ProcessId> waits_for() const override {
    std::vector<machine::ProcessId> writers;
    for (const Guard& guard : guards)
      if (guard.condition && guard.channel && !guard.channel->cut() &&
          guard.channel->last_writer() != 0)
        writers.push_back(guard.channel->last_writer());
    return writers;
  }
  Kind kind() const override { return Kind::alternative; }
  std::span<const Guard> guards;
};

// Blocks until an open guard may be ready.
void wait_for_any(Process& self, std::span<const Guard> guards) {
  bool some_open = false;
  for (const Guard& guard : guards) {
    if (!guard.condition) continue;
    some_open = true;
    if (guard.channel) guard.channel->enable(self);
    if (guard.kind == Kind::timer)
      self.processor().wake_at(date_of(self, guard.tick), self, self.waits() + 1);
  }
  if (!some_open)
    throw machine::Misuse(self.name(), self.own_time(),
                          fmt::format("{} on {} is in an ALT without an open guard at {:.6f} s",
                                      self.name(), self.processor().name(), self.own_time().value));
  AltWait wait(guards);
  self.block(wait);
  for (const Guard& guard : guards)
    if (guard.condition && guard.channel) guard.channel->disable();
}

// The guards are disabled again in order, and the first that is ready when its turn comes is taken;
// none is if the link of the one that was ready has been cut.
std::optional<std::size_t> choose(const Process& self, std::span<const Guard> guards,
                                  Seconds from) {
  const auto& costs = self.processor().model().alternative;
  Cycles spent{};
  for (std::size_t i = 0; i < guards.size(); ++i) {
    spent += cost_to_disable(costs, guards[i]);
    if (is_ready(self, guards[i], [&] { return from + self.processor().duration(spent); }))
      return i;
  }
  if (any_cut(guards)) return {};
  throw base::InvariantBroken(self.name() + ": an ALT woke without a ready guard");
}

// The cost of alt, and of enabling each guard at its own turn.
Cycles cost_to_enable_all(const Process& self, std::span<const Guard> guards, Seconds from) {
  const auto& costs = self.processor().model().alternative;
  Cycles spent = compiled(has_timer(guards) ? costs.timer_setup : costs.setup);
  for (const Guard& guard : guards) {
    const auto turn = [&] { return from + self.processor().duration(spent); };
    spent += cost_to_enable(costs, guard, is_ready(self, guard, turn));
  }
  return spent;
}

}  // namespace

std::size_t select(std::span<const Guard> guards) {
  Process& self = this_process();
  const auto& costs = self.processor().model().alternative;
  // An output of another CPU can come from a time that is behind this process's own: whether it
  // waits is certain only when the clock has come so far.
  bool looks_at_others = false;
  for (const Guard& guard : guards) {
    if (!guard.condition || !guard.channel) continue;
    guard.channel->take_input(self);
    looks_at_others |= guard.channel->joins_cpus();
  }
  // Returns whether others may have run.
  auto settle = [&] {
    const bool waited = looks_at_others && self.sync();
    return self.sync_if_long() || waited;
  };
  auto some_ready = [&] {
    return std::ranges::any_of(
        guards, [&](const Guard& g) { return is_ready(self, g, [&] { return self.own_time(); }); });
  };

  settle();
  // An output may come while the guards are enabled: what that adds is spent when it is known.
  const Seconds begin = self.own_time();
  Cycles enabled{};
  const auto spend_enabling = [&] {
    const Cycles known = cost_to_enable_all(self, guards, begin);
    if (known < enabled && any_cut(guards)) return;  // what was ready is not any more
    self.charge(Cycles{known.value - enabled.value});
    enabled = known;
  };
  spend_enabling();
  bool ready = some_ready();
  if (!ready && settle()) {
    ready = some_ready();
    spend_enabling();
  }
  if (has_timer(guards))
    charge(ready ? costs.timer_wait_ready : costs.timer_wait_not);
  else
    charge(ready ? costs.wait_ready : costs.wait_not);
  settle();
  Cycles disabling = compiled(costs.end);
  for (const Guard& guard : guards) disabling += cost_to_disable(costs, guard);
  for (;; ready = false) {
    if (!ready && !some_ready()) wait_for_any(self, guards);
    spend_enabling();
    const Seconds from = self.own_time();
    self.charge(disabling);
    settle();
    const auto chosen = choose(self, guards, from);
    if (!chosen) continue;
    for (const Guard& guard : guards)
      if (guard.condition && guard.channel) guard.channel->leave_input();
    return *chosen;
  }
}

}  // namespace occam
