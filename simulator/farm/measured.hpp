#pragma once
// What a run of the farm measures, the columns that show it, and what limits the farm: which of its
// resources is busy when others wait for it.
#include "simulator/farm/shared_farm.hpp"
#include "simulator/tracing/busy.hpp"

namespace farm {

using programs::Load;

/// The resources that can limit the farm, such as "worker1 (routing)", the busiest first:
/// - "workers": their CPUs on average, with how much of it was routing;
/// - "workerN (routing)": the routers of the one that routes most, at high priority;
/// - "coordination": the process, whenever it was not waiting for its workers: it takes turns with
///   the ray database and the display, so that it can be the limit while its CPU is idle;
/// - "database", "display": their CPUs, where they have processors of their own;
/// - "link A>B": the busiest direction of a link;
/// - "tasks": the share of the time after the last task was handed out, when workers end one after
///   the other.
/// Empty for a run that was cut short before its first task.
std::vector<Load> find_loads(const Result& result);

struct Measured {
  Measured(Result result, tracing::DataFigures data_figures);

  Result run;
  tracing::DataFigures data;
  tracing::Busy busy;
  growth::Figures growth = {};
  std::vector<Load> loads;  ///< the farm's resources, the busiest first
};

base::Columns<Measured> make_columns();

}  // namespace farm
