#pragma once
// Loads of processors and links in a ray tracing program, and the program's bottleneck.
#include "simulator/programs/declare/program.hpp"

namespace ray_tracing {

enum class Role : std::uint8_t {
  coordinator,
  worker,
  database,
  display,
  router  ///< routes messages and manages data for a worker, with which it shares a memory
};
/// The name of a role, as returned by machine::Processor::role().
std::string to_string(Role role);
bool has_role(const observe::CpuRow& cpu, Role role);
/// The first processor with this role; null if there is none.
const observe::CpuRow* find_role(const observe::Use& use, Role role);

/// A resource with at least this load is a bottleneck. If even the busiest resource has a lower
/// load, there is no bottleneck: processes then mostly wait for messages in transit.
constexpr double SATURATED = 0.8;

/// Loads of processors and links, as fractions of time.
struct Busy {
  double worker_mean = 0, worker_max = 0;
  /// Load of each of these processes; absent if the process has no CPU of its own.
  std::optional<double> coordinator, database, display;
  /// Mean load of the second processors (companions) of workers, if these route messages.
  std::optional<double> router_mean;
  std::string cpu_busiest;
  /// Load of the busiest CPU, and the part of it at high priority.
  double cpu_max = 0, cpu_high = 0;
  std::string link_busiest;  ///< busiest direction of a link, as "from>to"
  double link_max = 0;
  std::uint64_t link_messages = 0, link_bytes = 0;  ///< messages and bytes on link_busiest
  std::uint64_t worker_memory = 0;                  ///< maximum number of bytes used on a worker
};

/// Throws base::BadInput if the label of processor `id` is a name that the program itself uses.
void check_label(const topologies::Topology& topology, int id);

/// Computes the loads. If the run ended before its first task, all loads are 0.
Busy make_busy(const observe::Use& use);
base::Columns<Busy> busy_columns();
/// The column cpu_busy_router_mean. It is absent unless workers have a second processor (companion)
/// that routes.
base::Columns<Busy> router_columns();

using programs::Load;
using Loads = std::vector<Load>;
/// Loads of the resources that all these programs have, busiest first:
/// - "workers": mean load of their CPUs, with the fraction spent on routing;
/// - "workerN (routing)": load by high-priority processes, for the worker that routes most;
/// - "data managers": mean load of the CPUs of workers' second processors, if these route messages;
/// - "link A>B": the busiest direction of a link;
/// - the database and the display, if they have CPUs of their own;
/// - `coordination`, and `tasks` (the time after the last task was sent), as given by the caller.
Loads find_loads(const observe::Use& use, const Load& coordination, const Load& tasks);
/// The column other_models_tasks. It is absent if all processors have the same model.
base::Columns<observe::Use> model_columns();
/// If the workers have several models, makes a sentence for each model: number of workers, their
/// load, and the fraction of tasks that they did, if tasks are counted.
std::vector<std::string> note_models(const observe::Use& use);
std::string percent(double share);  ///< formats a fraction, for instance as "12 %"
/// Columns for a sorted list of loads: bottleneck, busiest, next_busiest, and their fractions.
base::Columns<Loads> bottleneck_columns();

}  // namespace ray_tracing
