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

/// PAR: runs all branches on this process's processor and returns when the last has ended. The last
/// branch with this process's priority runs in this process. The others are started by startp, or
/// by runp for another priority (PRI PAR); each branch ends with endp.
void par(std::initializer_list<Branch> branches);
void par(std::span<const Branch> branches);

/// Spends one iteration of WHILE: test of the condition and of the loop's input, jump back. Returns
/// the condition.
bool turn(bool condition);

/// TIMER ? now: the clock of this process's priority, in whole ticks (1 us high, 64 us low).
std::int64_t read_timer();
/// Blocks until the clock is at `tick` or later; occam's TIMER ? AFTER t is wait_until(t + 1).
void wait_until(std::int64_t tick);
/// Date at which the clock of `process`'s priority reaches `tick`.
Seconds date_of(const Process& process, std::int64_t tick);
/// A duration in ticks of this process's clock, rounded.
std::int64_t ticks(Seconds duration);

}  // namespace occam
