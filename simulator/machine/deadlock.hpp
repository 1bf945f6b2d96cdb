#pragma once
// What to say of a machine in which nothing can happen any more.
#include "simulator/machine/machine.hpp"

namespace machine {

// Throws Deadlock if some processes have not ended: each with its processor, what it waits for and
// whose turn it is, and the cycle of waits if there is one.
void throw_if_deadlocked(const Machine& machine);

}  // namespace machine
