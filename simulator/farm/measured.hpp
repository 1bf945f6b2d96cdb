#pragma once
// Measurements of a farm run, their columns, and the bottlenecks of the farm.
#include "simulator/farm/shared_farm.hpp"
#include "simulator/ray_tracing/program.hpp"

namespace farm {

using programs::Load;

/// Possible bottlenecks of the farm with their loads (fractions from 0 to 1), busiest first:
/// - "workers": mean load of their CPUs, with the fraction spent on routing;
/// - "workerN (routing)": load by high-priority routers, for the worker that routes most;
/// - "coordination": fraction of time in which the coordination process did not wait for workers.
///   While this process waits for the ray database or the display, it is a bottleneck even though
///   its CPU is idle;
/// - "database", "display": load of their CPUs, if they have processors of their own;
/// - "link A>B": the busiest direction of a link;
/// - "tasks": fraction of time after the last task was sent, when workers become idle.
/// The list is empty for a run that was cut short before its first task.
std::vector<Load> find_loads(const Result& result);

using Measured = ray_tracing::Measured<Result>;

base::Columns<Measured> make_columns();
programs::Shows make_shows();

}  // namespace farm
