#pragma once
// PAR, WHILE and timers of occam.
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

/// PAR: executes all branches on this processor, and returns when the last one has ended. The
/// calling process itself executes the last of the branches that have its own priority. The other
/// branches are started by the instruction startp, or runp if their priority differs (PRI PAR).
/// Each branch ends with the instruction endp.
void par(std::initializer_list<Branch> branches);
void par(std::span<const Branch> branches);

/// Charges one iteration of a WHILE loop, and returns the condition. The cost includes the test of
/// the condition, the test of the loop's input, and the jump back.
bool turn(bool condition);

/// TIMER ? now: reads the clock of this process's priority. Returns complete ticks, which last 1 us
/// at high priority and 64 us at low priority.
std::int64_t read_timer();
/// Blocks until the clock of this process's priority reaches `tick`. The occam statement TIMER ?
/// AFTER t is wait_until(t + 1).
void wait_until(std::int64_t tick);
/// The date at which the clock for the priority of `process` reaches `tick`.
Seconds date_of(const Process& process, std::int64_t tick);
/// Converts a duration to ticks of the clock of this process's priority, rounded to the nearest
/// tick.
std::int64_t ticks(Seconds duration);

}  // namespace occam
