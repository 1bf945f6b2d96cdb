#pragma once
// Measurements of a farm run, their columns, and the resources that limit the farm: those that are
// busy while others wait.
#include "simulator/farm/shared_farm.hpp"
#include "simulator/ray_tracing/busy.hpp"

namespace farm {

using programs::Load;

/// Resources that can limit the farm, such as "worker1 (routing)", busiest first:
/// - "workers": mean load of their CPUs, with the share spent on routing;
/// - "workerN (routing)": high-priority routers of the worker that routes most;
/// - "coordination": share of time in which the process did not wait for workers. It waits for the
///   ray database and the display, so it can be the limit while its CPU is idle;
/// - "database", "display": their CPUs, if they have processors of their own;
/// - "link A>B": the busiest direction of a link;
/// - "tasks": share of the time after the last task was handed out, when workers fall idle.
/// Empty for a run cut short before its first task.
std::vector<Load> find_loads(const Result& result);

struct Measured {
  Measured(Result result, ray_tracing::DataFigures data_figures);

  Result run;
  ray_tracing::DataFigures data;
  ray_tracing::Busy busy;
  snapshots::Figures growth = {};
  std::vector<Load> loads;  ///< resources of the farm, busiest first
};

base::Columns<Measured> make_columns();

}  // namespace farm
