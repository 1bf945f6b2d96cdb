#pragma once
// PAR and timers.
#include <initializer_list>
#include <string>

#include "simulator/machine/process.hpp"
#include "simulator/machine/processor.hpp"

namespace occam {

using machine::Cycles;
using machine::Priority;
using machine::Seconds;

struct Branch {
  std::string name;
  Priority priority;
  machine::Process::Body body;
};

// PAR: runs all branches on this process's processor, and returns when the last has ended.
void par(std::initializer_list<Branch> branches);

// TIMER ? now: the clock as this process's priority sees it, in whole ticks (1 us or 64 us).
std::int64_t read_timer();
// TIMER ? AFTER tick: blocks until the clock is at `tick` or later.
void wait_until(std::int64_t tick);
std::int64_t ticks(Seconds duration);

}  // namespace occam
