// The list of patterns, and how they read their parameters.
#include <cmath>

#include "simulator/machine/faults.hpp"
#include "simulator/patterns/pattern.hpp"

namespace patterns {

// Each in the file of its name.
Pattern make_message();
Pattern make_soft();
Pattern make_both_ways();
Pattern make_unicast();
Pattern make_pipeline();
Pattern make_sources();
Pattern make_broadcast();
Pattern make_request();
Pattern make_alternative();
Pattern make_interrupt();
Pattern make_traffic();
Pattern make_task_farm();
Pattern make_law();
Pattern make_commstime();
Pattern make_flops();
Pattern make_metrics();
Pattern make_deadlock();

const std::vector<Pattern>& all_patterns() {
  static const std::vector<Pattern> all = {
      make_message(), make_soft(),      make_both_ways(), make_unicast(),     make_pipeline(),
      make_sources(), make_broadcast(), make_request(),   make_alternative(), make_interrupt(),
      make_traffic(), make_task_farm(), make_law(),       make_commstime(),   make_flops(),
      make_metrics(), make_deadlock(),
  };
  return all;
}

void run_machine(const Setup& setup, machine::Machine& machine) {
  observe::Watch none;
  const machine::End end = observe::run(machine, setup.watch ? *setup.watch : none);
  if (end != machine::End::done)
    throw Unfinished(
        "machine", machine.now(),
        fmt::format("the run was ended at {:.6f} s ({})", machine.now().value, to_string(end)));
}

double Setup::operator[](std::string_view name) const {
  const auto found = parameters.find(name);
  if (found == parameters.end())
    throw machine::InvariantBroken(fmt::format("the pattern has no parameter {}", name));
  return found->second;
}

std::int64_t Setup::whole(std::string_view name) const { return std::llround((*this)[name]); }

}  // namespace patterns
