#pragma once
// Runs a machine with a time limit, observers and a trace.
#include "simulator/machine/machine.hpp"
#include "simulator/observe/run_observers.hpp"
#include "simulator/observe/trace.hpp"

namespace observe {

/// Limit and observers of a run, set before it, and its outcome, stored after it.
struct RunMonitor {
  machine::Seconds until{std::numeric_limits<double>::infinity()};  ///< limit in simulated seconds
  machine::Seconds from{};              ///< date at which the trace starts
  Trace* trace = nullptr;               ///< trace to be filled during the run; may be null
  RunController* controller = nullptr;  ///< controls the speed of the run; may be null
  RunObserver* observer = nullptr;      ///< follows the run; may be null

  machine::End end = machine::End::done;  ///< reason for the end of the run
  std::exception_ptr deadlock = {};       ///< the exception thrown, if `end` is End::deadlock
  machine::Seconds ended{};               ///< date of the end
  std::uint64_t events = 0;               ///< number of simulated events
};

/// True if the run has a controller.
inline bool has_controller(const RunMonitor* monitor) { return monitor && monitor->controller; }

/// True if the run has a controller or an observer. Both may show the picture.
inline bool is_observed(const RunMonitor* monitor) {
  return monitor && (monitor->controller || monitor->observer);
}

/// Tells the observer, if there is one, that the picture is going to change at the date `now`.
inline void notify_change(const RunMonitor* monitor, machine::Seconds now) {
  if (monitor && monitor->observer) monitor->observer->before_change(now.value);
}

/// Runs a machine and stores the outcome in `monitor`. Throws the exceptions of Machine::run, but
/// fills the trace even then. After a failure of a link or a processor, a deadlock is a valid
/// outcome of the experiment: it is not thrown but returned as End::deadlock.
machine::End run(machine::Machine& machine, RunMonitor& monitor, const ControlPanel& view = {});
/// If `monitor` is not null, calls the function above. Otherwise runs the machine without a limit,
/// stores no outcome and throws every Deadlock.
machine::End run(machine::Machine& machine, RunMonitor* monitor, const ControlPanel& view = {});

}  // namespace observe
