#pragma once
// The report on a machine in which nothing can happen any more.
#include "simulator/machine/machine.hpp"

namespace machine {

/// Whether a process of the processor has not ended, and is no server that waits for input.
bool has_unfinished(const Processor& processor);
/// Whether there is no such process on any processor that runs.
bool all_have_ended(const Machine& machine);

/// Throws Deadlock if some processes have not ended. The text names each of them, its processor,
/// what it waits for and from which processes, and the cycle of waits if there is one.
void throw_if_deadlocked(const Machine& machine);

}  // namespace machine
