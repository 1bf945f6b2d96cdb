#include "simulator/occam/alt.hpp"

#include <algorithm>

#include "simulator/machine/faults.hpp"

namespace occam {

namespace {

bool is_ready(const Guard& guard, machine::Seconds at) {
  return guard.condition && (!guard.channel || guard.channel->output_waits(at));
}

auto find_ready(std::span<const Guard> guards, machine::Seconds at) {
  return std::ranges::find_if(guards, [at](const Guard& g) { return is_ready(g, at); });
}

// What a deadlock report says of a process that waits for any of these.
struct Guards : machine::Wait {
  explicit Guards(std::span<const Guard> guards) : guards(guards) {}
  std::string describe() const override {
    std::string names;
    for (const Guard& guard : guards)
      if (guard.condition && guard.channel)
        names += (names.empty() ? "alt on " : ", ") + guard.channel->name();
    return names;
  }
  std::span<const Guard> guards;
};

// Blocks until an open guard may be ready.
void wait_for_any(Process& self, std::span<const Guard> guards) {
  bool some_open = false;
  for (const Guard& guard : guards)
    if (guard.condition && guard.channel) {
      guard.channel->enable(self);
      some_open = true;
    }
  if (!some_open) throw machine::InvariantBroken(self.name() + ": an ALT without an open guard");
  self.block(Guards(guards));
  for (const Guard& guard : guards)
    if (guard.channel) guard.channel->disable();
}

}  // namespace

std::size_t select(std::span<const Guard> guards) {
  Process& self = this_process();
  const auto& costs = self.processor().model().alternative;
  // The guards are disabled again in order, and the first ready one is taken.
  const Cycles choosing = static_cast<std::int64_t>(guards.size()) * costs.disable + costs.end;
  // Whether an output waits is certain only when the clock has reached this process's own time: on
  // a link it can come from a processor that is not so far yet.
  const bool looks_at_links = std::ranges::any_of(
      guards, [](const Guard& g) { return g.condition && g.channel && g.channel->hard(); });
  auto settle = [&] {
    if (looks_at_links) self.sync();
    self.sync_if_low();
  };

  settle();
  Cycles enabling = costs.setup;
  bool some_ready = false;
  for (const Guard& guard : guards) {
    const bool ready = is_ready(guard, self.now());
    enabling += ready ? costs.enable_ready : costs.enable_not;
    some_ready |= ready;
  }

  charge(enabling + (some_ready ? costs.wait_ready + choosing : costs.wait_not));
  settle();
  auto chosen = find_ready(guards, self.now());
  if (!some_ready) {
    if (chosen == guards.end()) wait_for_any(self, guards);
    charge(choosing);
    settle();
    chosen = find_ready(guards, self.now());
  }
  if (chosen == guards.end())
    throw machine::InvariantBroken(self.name() + ": an ALT woke without a ready guard");
  return static_cast<std::size_t>(chosen - guards.begin());
}

}  // namespace occam
