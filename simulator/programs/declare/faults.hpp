#pragma once
// Failures of links and processors that an experiment plans for a program's run.
#include <vector>

#include "simulator/machine/machine.hpp"

namespace programs {

/// Planned failure of a link or a processor.
struct PlannedFault {
  double at_s = 0;
  int a = 0;
  int b = -1;  ///< processor at the other end of the link; -1 if processor a itself stops

  bool operator==(const PlannedFault&) const = default;
};

/// Schedules the faults. `find` returns the machine's processor for a number in the faults.
void plan_faults(machine::Machine& machine, const std::vector<PlannedFault>& faults, auto find) {
  for (const PlannedFault& fault : faults)
    if (fault.b < 0)
      machine.stop_processor(find(fault.a), {fault.at_s});
    else
      machine.cut_link(find(fault.a), find(fault.b), {fault.at_s});
}

}  // namespace programs
