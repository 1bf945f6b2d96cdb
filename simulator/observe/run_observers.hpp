#pragma once
// Interfaces of those that follow a run: a read-only observer, and a controller of its pace.
#include "simulator/observe/control_panel.hpp"

namespace observe {

/// Read-only observer of a run, on any engine.
struct RunObserver {
  virtual ~RunObserver() = default;
  /// Called before the machine runs; `machine` and `view` live until `end`.
  virtual void begin(const machine::Machine& machine, const ControlPanel& view) = 0;
  /// Called when ControlPanel::picture, if there is one, is about to change after `now_s`.
  virtual void before_change(double now_s) = 0;
  /// Called after the run.
  virtual void end(double now_s) = 0;
};

/// Observer that also controls the pace of a run, for machines with Links::direct.
struct RunController : machine::Pace {
  /// Called before the machine runs; `machine` and `view` live until `end`.
  virtual void begin(machine::Machine& machine, const ControlPanel& view) = 0;
  /// Called after the run; `fault` is the reason if it failed, else empty.
  virtual void end(const std::string& fault) = 0;
};

}  // namespace observe
