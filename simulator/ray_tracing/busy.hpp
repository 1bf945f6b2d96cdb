#pragma once
// Load of the processors and links of a ray tracing program, and its bottleneck.
#include "simulator/programs/declare/program.hpp"

namespace ray_tracing {

/// Purpose of a processor, see machine::Processor::role().
struct Role {
  static constexpr auto coordinator = "coordinator", worker = "worker", database = "database",
                        display = "display",
                        router = "router";  ///< routes for its companion, a worker
};

/// Minimum load of the busiest resource to count as the bottleneck. Below it there is none: all
/// processes wait for messages under way.
constexpr double SATURATED = 0.8;

/// Loads of processors and links, as shares of the time, 0 to 1.
struct Busy {
  double worker_mean = 0, worker_max = 0;
  std::optional<double> coordinator, database, display;  ///< if they have own processors
  std::optional<double> router_mean;                     ///< the same
  std::string cpu_busiest;
  double cpu_max = 0, cpu_high = 0;  ///< busiest CPU: all its processes, high-priority ones
  std::string link_busiest;          ///< "from>to"
  double link_max = 0;
  std::uint64_t link_messages = 0, link_bytes = 0;  ///< of the busiest direction of a link
  std::uint64_t worker_memory = 0;                  ///< bytes, maximum over the workers
};

/// Throws base::BadInput if the processor's label is the name of another part of the program.
void check_label(const topologies::Topology& topology, int id);

/// Computes the loads; all 0 if the run ended before its first task.
Busy make_busy(const observe::Use& use);
base::Columns<Busy> busy_columns();
/// The column cpu_busy_router_mean; absent without such processors.
base::Columns<Busy> router_columns();

using programs::Load;
using Loads = std::vector<Load>;
/// Loads of the resources common to all programs: - "workers": mean of their CPUs, with the share
/// of routing; - "workerN (routing)": high priority on the worker that routes most; - "data
/// managers": mean of the CPUs of workers' companions, if these route for them; - "link A>B": the
/// busiest direction of a link.
Loads find_loads(const observe::Use& use);
/// The column other_models_tasks; absent if all processors are of one model.
base::Columns<observe::Use> model_columns();
/// A sentence for each model of workers, if there are several: their number, load, and share of the
/// tasks if tasks are counted.
std::vector<std::string> note_models(const observe::Use& use);
void sort(Loads& loads);            ///< busiest first
std::string percent(double share);  ///< "12 %"
/// Columns of sorted loads: bottleneck, busiest, next_busiest and their shares.
base::Columns<Loads> bottleneck_columns();

}  // namespace ray_tracing
