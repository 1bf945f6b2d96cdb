#pragma once
// A program on a processor: its share of the memory, and its processes.
#include "simulator/machine/machine.hpp"

namespace kernels {

/// Takes the program's part of a processor's memory.
void load_program(machine::Processor& processor);

/// Starts a process called "processor.name".
void start(machine::Processor& on, const char* name, machine::Priority priority,
           machine::Process::Body body);

/// Calls `body` with so many bytes of this process's processor's memory taken.
template <class Body>
auto with_memory(std::uint64_t bytes, const char* what, Body body) {
  auto& self = machine::this_process();
  self.processor().memory().allocate(bytes, what, self.now());
  auto result = body();
  self.processor().memory().release(bytes);
  return result;
}

}  // namespace kernels
