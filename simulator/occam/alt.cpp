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

// Blocks until an open guard may be ready.
void wait_for_any(Process& self, std::span<const Guard> guards) {
  static const std::string several = "one of several channels";
  std::size_t open = 0;
  const ChannelBase* last = nullptr;
  for (const Guard& guard : guards)
    if (guard.condition && guard.channel) {
      guard.channel->enable(self);
      last = guard.channel;
      ++open;
    }
  if (!last) throw machine::InvariantBroken(self.name() + ": an ALT without an open guard");
  self.block("alt", open == 1 ? last->name() : several);
  for (const Guard& guard : guards)
    if (guard.channel) guard.channel->disable();
}

}  // namespace

std::size_t select(std::span<const Guard> guards) {
  Process& self = this_process();
  const auto& costs = self.processor().model().alternative;
  // The guards are disabled again in order, the first ready one is taken, and its input begins.
  const Cycles choosing = static_cast<std::int64_t>(guards.size()) * costs.disable + costs.end +
                          self.processor().model().channel.blocked;
  Cycles enabling = costs.setup;
  bool some_ready = false;
  for (const Guard& guard : guards) {
    const bool ready = is_ready(guard, self.now());
    enabling += ready ? costs.enable_ready : costs.enable_not;
    some_ready |= ready;
  }

  charge(enabling + (some_ready ? costs.wait_ready + choosing : costs.wait_not));
  self.sync_if_low();
  if (some_ready) self.sync();  // a guard earlier in the order may become ready meanwhile
  auto chosen = find_ready(guards, self.now());
  if (!some_ready) {
    if (chosen == guards.end()) wait_for_any(self, guards);
    charge(choosing);
    self.sync_if_low();
    chosen = find_ready(guards, self.now());
  }
  if (chosen == guards.end())
    throw machine::InvariantBroken(self.name() + ": an ALT woke without a ready guard");
  return static_cast<std::size_t>(chosen - guards.begin());
}

}  // namespace occam
