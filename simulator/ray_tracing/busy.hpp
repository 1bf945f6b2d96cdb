#pragma once
// Load of the processors and links in a ray tracing program, and its bottleneck.
#include "simulator/programs/declare/program.hpp"

namespace ray_tracing {

enum class Role : std::uint8_t {
  coordinator,
  worker,
  database,
  display,
  router  ///< routes messages for its companion, a worker
};
/// The name of a role, see machine::Processor::role().
std::string to_string(Role role);
bool has_role(const observe::CpuRow& cpu, Role role);
/// The first processor with this role; null if there is none.
const observe::CpuRow* find_role(const observe::Use& use, Role role);

/// The busiest resource is a bottleneck if its load is at least this. With a lower load there is no
/// bottleneck: all processes are then waiting for messages in transit.
constexpr double SATURATED = 0.8;

/// Loads of processors and links, as fractions of time.
struct Busy {
  double worker_mean = 0, worker_max = 0;
  std::optional<double> coordinator, database, display;  ///< absent if it has no CPU of its own
  std::optional<double> router_mean;                     ///< set if companions route
  std::string cpu_busiest;
  double cpu_max = 0, cpu_high = 0;  ///< load of the busiest CPU; part at high priority
  std::string link_busiest;          ///< "from>to"
  double link_max = 0;
  std::uint64_t link_messages = 0, link_bytes = 0;  ///< traffic of link_busiest
  std::uint64_t worker_memory = 0;                  ///< maximum over the workers in bytes
};

/// Throws base::BadInput if the processor's label is a name that the program uses itself.
void check_label(const topologies::Topology& topology, int id);

/// Computes the loads; all are 0 if the run ended before its first task.
Busy make_busy(const observe::Use& use);
base::Columns<Busy> busy_columns();
/// The column cpu_busy_router_mean; absent if no companions route.
base::Columns<Busy> router_columns();

using programs::Load;
using Loads = std::vector<Load>;
/// Loads of the resources that all programs have:
/// - "workers": mean load of their CPUs, with the fraction spent on routing;
/// - "workerN (routing)": high-priority processes of the worker with the most routing;
/// - "data managers": mean load of the CPUs of workers' companions, if these route messages;
/// - "link A>B": the busiest direction of a link.
/// - `coordination`, the database and the display;
/// - `tasks`, the time after the last task was sent.
/// The busiest comes first.
Loads find_loads(const observe::Use& use, const Load& coordination, const Load& tasks);
/// The column other_models_tasks. Absent if all processors have the same model.
base::Columns<observe::Use> model_columns();
/// If workers have several models, makes a sentence for each model: number of workers, their load,
/// and their fraction of the tasks if these are counted.
std::vector<std::string> note_models(const observe::Use& use);
std::string percent(double share);  ///< such as "12 %"
/// Columns for sorted loads: bottleneck, busiest, next_busiest and their fractions.
base::Columns<Loads> bottleneck_columns();

}  // namespace ray_tracing
