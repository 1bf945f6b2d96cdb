#pragma once
// How busy the processors and links of a program that traces rays were, and what limits it: which
// of its resources is busy when others wait for it.
#include "simulator/declare/program.hpp"

namespace tracing {

/// What a processor is for, see machine::Processor::role().
struct Role {
  static constexpr auto coordinator = "coordinator", worker = "worker", database = "database",
                        display = "display",
                        router = "router";  ///< of a node whose worker is its companion
};

/// The busiest resource limits the program if it was busy for at least this share of the time; else
/// nothing does: all wait for messages that are on their way.
constexpr double SATURATED = 0.8;

/// How busy processors and links were, as shares of the time, 0 to 1.
struct Busy {
  double worker_mean = 0, worker_max = 0;
  std::optional<double> coordinator, database, display;  ///< where they have processors
  std::optional<double> router_mean;                     ///< the same
  std::string cpu_busiest;
  double cpu_max = 0, cpu_high = 0;  ///< the busiest CPU; its high priority
  std::string link_busiest;          ///< "from>to"
  double link_max = 0;
  std::uint64_t link_messages = 0, link_bytes = 0;  ///< over the busiest direction of a link
  std::uint64_t worker_memory = 0;                  ///< bytes, the most that a worker used
};

/// Throws base::BadInput for a processor whose label is the name of another part of the program.
void check_label(const topologies::Topology& topology, int id);

/// All 0 for a run that was cut short before its first task.
Busy make_busy(const observe::Use& use);
base::Columns<Busy> busy_columns();
/// The column cpu_busy_router_mean; missing where there are no such processors.
base::Columns<Busy> router_columns();

using programs::Load;
using Loads = std::vector<Load>;
/// The resources that every program has:
/// - "workers": their CPUs on average, with how much of it was routing;
/// - "workerN (routing)": the routers of the one that routes most, at high priority;
/// - "data managers": the CPUs of workers' companions on average, where these route for them;
/// - "link A>B": the busiest direction of a link.
Loads find_loads(const observe::Use& use);
/// The column other_models_tasks; missing where all are of one model.
base::Columns<observe::Use> model_columns();
/// Where workers are of several models, a sentence for each: how many, how busy, what share of the
/// tasks they did if that is counted.
std::vector<std::string> note_models(const observe::Use& use);
void sort(Loads& loads);            ///< the busiest first
std::string percent(double share);  ///< "12 %"
/// Of loads that are sorted: bottleneck, busiest, next_busiest and their shares.
base::Columns<Loads> bottleneck_columns();

}  // namespace tracing
