#pragma once
// Interfaces for following a run: a read-only observer, and a controller of its speed.
#include "simulator/observe/control_panel.hpp"

namespace observe {

/// Read-only observer of a run, with either engine.
struct RunObserver {
  virtual ~RunObserver() = default;
  /// Called before the machine runs. `machine` and `view` remain valid until `end`.
  virtual void begin(const machine::Machine& machine, const ControlPanel& view) = 0;
  /// Called before ControlPanel::picture, if present, changes at `now_s`.
  virtual void before_change(double now_s) = 0;
  /// Called after the run.
  virtual void end(double now_s) = 0;
};

/// Observer that also controls the speed of a run, for machines with Links::direct.
struct RunController : machine::Pace {
  /// Called before the machine runs. `machine` and `view` remain valid until `end`.
  virtual void begin(machine::Machine& machine, const ControlPanel& view) = 0;
  /// Called after the run. `fault` describes the failure, and is empty after success.
  virtual void end(const std::string& fault) = 0;
};

}  // namespace observe
