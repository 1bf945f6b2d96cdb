#pragma once
// PAR, WHILE and timers.
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

/// PAR: executes all branches on this processor and returns when the last one has ended. The last
/// branch with this process's priority is executed by this process itself. The others are started
/// by startp, or by runp if their priority differs (PRI PAR). Each branch ends with endp.
void par(std::initializer_list<Branch> branches);
void par(std::span<const Branch> branches);

/// Charges one iteration of WHILE and returns the condition. The cost covers the test of the
/// condition and of the loop's input, and the jump back.
bool turn(bool condition);

/// TIMER ? now: reads the clock of this process's priority, in complete ticks (1 us for high
/// priority, 64 us for low).
std::int64_t read_timer();
/// Blocks until the clock reaches `tick`. occam's TIMER ? AFTER t is wait_until(t + 1).
void wait_until(std::int64_t tick);
/// The date at which the clock of `process`'s priority reaches `tick`.
Seconds date_of(const Process& process, std::int64_t tick);
/// Converts a duration to ticks of this process's clock, rounded to the nearest.
std::int64_t ticks(Seconds duration);

}  // namespace occam
