#pragma once
// Interfaces for following a run: an observer that only reads, and a controller of the run's speed.
#include "simulator/observe/control_panel.hpp"

namespace observe {

/// Observer of a run that only reads. Works with and without SimGrid.
struct RunObserver {
  virtual ~RunObserver() = default;
  /// Called before the machine runs. `machine` and `view` remain valid until `end`.
  virtual void begin(const machine::Machine& machine, const ControlPanel& view) = 0;
  /// Called before the picture of the control panel, if there is one, changes at the date `now_s`.
  virtual void before_change(double now_s) = 0;
  /// Called after the run, which ended at the date `now_s` in seconds.
  virtual void end(double now_s) = 0;
};

/// Observer that also controls the speed of a run. Only for machines without SimGrid
/// (Links::direct).
struct RunController : machine::Pace {
  /// Called before the machine runs. `machine` and `view` remain valid until `end`.
  virtual void begin(machine::Machine& machine, const ControlPanel& view) = 0;
  /// Called after the run. `fault` is the message of the fault that ended it, or empty.
  virtual void end(const std::string& fault) = 0;
};

}  // namespace observe
