#pragma once
// Runs of a machine with a time limit, observers and a trace.
#include "simulator/machine/machine.hpp"
#include "simulator/observe/run_observers.hpp"
#include "simulator/observe/trace.hpp"

namespace observe {

/// Limit and observers of a run, and its outcome.
struct RunMonitor {
  machine::Seconds until{std::numeric_limits<double>::infinity()};  ///< limit in simulated time
  machine::Seconds from{};                                          ///< start of the trace
  Trace* trace = nullptr;               ///< filled during the run; may be null
  RunController* controller = nullptr;  ///< may be null
  RunObserver* observer = nullptr;      ///< may be null

  machine::End end = machine::End::done;  ///< reason for the end of the run
  std::exception_ptr deadlock = {};       ///< the exception if `end` is End::deadlock
  machine::Seconds ended{};               ///< date of the end
  std::uint64_t events = 0;               ///< number of simulated events
};

/// True if the run has a controller.
inline bool has_controller(const RunMonitor* monitor) { return monitor && monitor->controller; }

/// True if the run has a controller or an observer, either of which may show the picture.
inline bool is_observed(const RunMonitor* monitor) {
  return monitor && (monitor->controller || monitor->observer);
}

/// Tells the observer, if there is one, that the picture is about to change.
inline void notify_change(const RunMonitor* monitor, machine::Seconds now) {
  if (monitor && monitor->observer) monitor->observer->before_change(now.value);
}

/// Runs a machine and stores the outcome in `monitor`. Throws the exceptions of Machine::run, but
/// fills the trace in any case. A deadlock after a failure of a link or processor is not thrown: it
/// is a valid outcome of the experiment, End::deadlock.
machine::End run(machine::Machine& machine, RunMonitor& monitor, const ControlPanel& view = {});
/// Runs a machine without a limit if `monitor` is null. Then no outcome is stored, and every
/// Deadlock is thrown.
machine::End run(machine::Machine& machine, RunMonitor* monitor, const ControlPanel& view = {});

}  // namespace observe
