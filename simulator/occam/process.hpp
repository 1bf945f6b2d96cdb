#pragma once
// PAR and timers.
#include <initializer_list>
#include <span>
#include <string>

#include "simulator/machine/processor.hpp"

namespace occam {

using machine::Cycles;
using machine::Priority;
using machine::Process;
using machine::Seconds;

struct Branch {
  std::string name;
  Priority priority;
  machine::Process::Body body;
};

/// PAR: runs all branches on this process's processor, and returns when the last has ended. The
/// last branch of this process's own priority runs in this process; each other is started (startp,
/// or runp for another priority: PRI PAR), and each ends with endp.
void par(std::initializer_list<Branch> branches);
void par(std::span<const Branch> branches);

/// A turn of WHILE condition: what it takes to look at the condition, at what the loop has read,
/// and to jump back. Returns the condition.
bool turn(bool condition);

/// TIMER ? now: the clock as this process's priority sees it, in whole ticks (1 us or 64 us).
std::int64_t read_timer();
/// Blocks until the clock is at `tick` or later; occam's TIMER ? AFTER t is wait_until(t + 1).
void wait_until(std::int64_t tick);
/// The date at which the clock that `process` sees comes to `tick`.
Seconds date_of(const Process& process, std::int64_t tick);
/// A duration in ticks of this process's clock, rounded.
std::int64_t ticks(Seconds duration);

}  // namespace occam
