#pragma once
// What a run of the farm measures, the columns that show it, and what limits the farm: which of its
// resources is busy when others wait for it.
#include "simulator/farm/shared_farm.hpp"

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

/// The busiest resource limits the farm if it was busy for at least this share of the time; else
/// nothing does: all wait for messages that are on their way.
constexpr double SATURATED = 0.8;

/// How busy processors and links were, as shares of the time, 0 to 1.
struct Busy {
  double worker_mean = 0, worker_max = 0;
  std::optional<double> coordinator, database, display;  ///< where they have processors
  std::string cpu_busiest;
  double cpu_max = 0, cpu_high = 0;  ///< the busiest CPU; its high priority
  std::string link_busiest;          ///< "from>to"
  double link_max = 0;
  std::uint64_t link_messages = 0, link_bytes = 0;  ///< over the busiest direction of a link
  std::uint64_t worker_memory = 0;                  ///< bytes, the most that a worker used
};

struct Measured {
  Measured(Result result, tracing::DataFigures data_figures);

  Result run;
  tracing::DataFigures data;
  Busy busy;
  growth::Figures growth = {};
  std::vector<Load> loads;  ///< the farm's resources, the busiest first
};

base::Columns<Measured> make_columns();

}  // namespace farm
