#pragma once
// A program on a processor: its share of the memory, and its processes.
#include "simulator/machine/machine.hpp"

namespace kernels {

// Takes the program's part of a processor's memory.
void load_program(machine::Processor& processor);

// Starts a process called "processor.name".
void start(machine::Processor& on, const char* name, machine::Priority priority,
           machine::Process::Body body);

}  // namespace kernels
