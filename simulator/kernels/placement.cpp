#include "simulator/kernels/placement.hpp"

#include <fmt/format.h>

namespace kernels {

void load_program(machine::Processor& processor) {
  processor.memory().allocate(get_bytes(processor.model(), "program"), "the program",
                              processor.now());
}

void start(machine::Processor& on, const char* name, machine::Priority priority,
           machine::Process::Body body) {
  on.start(fmt::format("{}.{}", on.name(), name), priority, std::move(body));
}

}  // namespace kernels
