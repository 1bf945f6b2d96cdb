#pragma once
// Runs of a machine with a time limit and a trace.
#include "simulator/machine/machine.hpp"
#include "simulator/observe/spectator.hpp"
#include "simulator/observe/trace.hpp"

namespace observe {

/// Limit, observers and end of a run.
struct Watch {
  machine::Seconds until{std::numeric_limits<double>::infinity()};  ///< simulated time limit
  machine::Seconds from{};                                          ///< start of the trace
  Trace* trace = nullptr;                                           ///< to be filled; may be null
  Spectator* spectator = nullptr;                                   ///< may be null
  Onlooker* onlooker = nullptr;                                     ///< may be null

  machine::End end = machine::End::done;  ///< reason for the end of the run
  std::exception_ptr deadlock;            ///< the Deadlock, for End::deadlock
  machine::Seconds ended{};               ///< date of the end
  std::uint64_t events = 0;               ///< number of simulated events
};

/// True if the run has a spectator.
inline bool is_watched(const Watch* watch) { return watch && watch->spectator; }

/// True if a spectator or an onlooker may look at the run's picture.
inline bool is_seen(const Watch* watch) { return watch && (watch->spectator || watch->onlooker); }

/// Notifies the onlooker, if there is one, before the picture changes.
inline void tell_change(const Watch* watch, machine::Seconds now) {
  if (watch && watch->onlooker) watch->onlooker->before_change(now.value);
}

/// Runs a complete machine and notes its end in `watch`. Throws the exceptions of Machine::run; the
/// trace is filled all the same. A deadlock after a failure of a link or processor is not thrown:
/// it is a valid end of the measurement, End::deadlock.
machine::End run(machine::Machine& machine, Watch& watch, const View& view = {});
/// The same; without limit and notes if `watch` is null, and then every Deadlock is thrown.
machine::End run(machine::Machine& machine, Watch* watch, const View& view = {});

}  // namespace observe
