#pragma once
// Runs of a machine with a time limit and a trace.
#include "simulator/machine/machine.hpp"
#include "simulator/observe/run_observers.hpp"
#include "simulator/observe/trace.hpp"

namespace observe {

/// Limit, observers and end of a run.
struct RunMonitor {
  machine::Seconds until{std::numeric_limits<double>::infinity()};  ///< simulated time limit
  machine::Seconds from{};                                          ///< start of the trace
  Trace* trace = nullptr;                                           ///< to be filled; may be null
  RunController* controller = nullptr;                              ///< may be null
  RunObserver* observer = nullptr;                                  ///< may be null

  machine::End end = machine::End::done;  ///< reason for the end of the run
  std::exception_ptr deadlock;            ///< the Deadlock, for End::deadlock
  machine::Seconds ended{};               ///< date of the end
  std::uint64_t events = 0;               ///< number of simulated events
};

/// True if the run has a controller.
inline bool has_controller(const RunMonitor* monitor) { return monitor && monitor->controller; }

/// True if a controller or an observer may look at the run's picture.
inline bool is_observed(const RunMonitor* monitor) {
  return monitor && (monitor->controller || monitor->observer);
}

/// Notifies the observer, if there is one, before the picture changes.
inline void notify_change(const RunMonitor* monitor, machine::Seconds now) {
  if (monitor && monitor->observer) monitor->observer->before_change(now.value);
}

/// Runs a complete machine and notes its end in `monitor`. Throws the exceptions of Machine::run;
/// the trace is filled all the same. A deadlock after a failure of a link or processor is not
/// thrown: it is a valid end of the measurement, End::deadlock.
machine::End run(machine::Machine& machine, RunMonitor& monitor, const ControlPanel& view = {});
/// The same; without limit and notes if `monitor` is null, and then every Deadlock is thrown.
machine::End run(machine::Machine& machine, RunMonitor* monitor, const ControlPanel& view = {});

}  // namespace observe
