#pragma once
// Runs of a machine with a limit, and with a trace of what it did.
#include "simulator/machine/machine.hpp"
#include "simulator/observe/spectator.hpp"
#include "simulator/observe/trace.hpp"

namespace observe {

/// Limits and records a run.
struct Watch {
  machine::Seconds until{std::numeric_limits<double>::infinity()};  ///< simulated
  machine::Seconds from{};                                          ///< simulated; of the trace
  Trace* trace = nullptr;                                           ///< filled, if there is one
  Spectator* spectator = nullptr;                                   ///< watches, if there is one
  Onlooker* onlooker = nullptr;                                     ///< looks, if there is one

  machine::End end = machine::End::done;  ///< why the run ended, and when
  std::exception_ptr deadlock;            ///< the Deadlock, if that is why
  machine::Seconds ended{};
  std::uint64_t events = 0;  ///< simulated
};

/// Whether somebody watches the run.
inline bool is_watched(const Watch* watch) { return watch && watch->spectator; }

/// Whether somebody may look at the picture of a run.
inline bool is_seen(const Watch* watch) { return watch && (watch->spectator || watch->onlooker); }

/// Tells who looks, if there is one, that the picture is about to change.
inline void tell_change(const Watch* watch, machine::Seconds now) {
  if (watch && watch->onlooker) watch->onlooker->before_change(now.value);
}

/// Runs the machine, all of whose processors and links are there, and notes its end in `watch`.
/// Throws what Machine::run throws; the trace is filled all the same. A deadlock of a machine in
/// which something is broken is no defect, but an end that what was measured has come to.
machine::End run(machine::Machine& machine, Watch& watch, const View& view = {});
/// The same without limit and notes if `watch` is null; then every Deadlock is thrown.
machine::End run(machine::Machine& machine, Watch* watch, const View& view = {});

}  // namespace observe
