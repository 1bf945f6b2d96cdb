#include "simulator/farm/measured.hpp"

#include "topologies/graph/all_pairs.hpp"

namespace farm {

using base::column;
using base::Columns;

namespace {

Load load_of_coordination(const Result& result) {
  const auto& use = result.use;
  const auto& cpu = *find_role(use, Role::coordinator);
  const auto& process = find_process(use, result.coordination);
  return {"coordination", 1 - process.alternative_s / use.time_s,
          fmt::format("its CPU {}, waiting to send {}, for replies {}",
                      ray_tracing::percent(cpu.busy_s / use.time_s),
                      ray_tracing::percent(process.output_s / use.time_s),
                      ray_tracing::percent(process.input_s / use.time_s))};
}

Columns<Result> task_columns() {
  using R = Result;
  return {
      column("tasks", &R::tasks, "rays or blocks handed out to workers"),
      column("kernel_cycles", &R::kernel_cycles, "cycles charged for the workers' tasks"),
      column("interactive_s", &R::interactive_s, "part of time_s in the interactive phase"),
      column(
          "reorder_pause_s", &R::reorder_pause_s,
          "longest time the ray database needed to reclassify all rays, for a stage or an order")};
}

Columns<Result> message_columns() {
  using R = Result;
  const auto distance = [](const R& r) { return topologies::eval_mean_distance(r.topology); };
  return base::join(Columns<R>{column<R>("mean_distance", distance,
                                         "mean distance between two workers, in links"),
                               column("mean_depth", &R::mean_depth,
                                      "mean distance from the coordinator to a worker, in links")},
                    {base::lift_columns<R>(observe::message_columns(), &R::use)});
}

Columns<Result> peak_columns() {
  using Peaks = RayStores::Lengths;
  return base::join(Columns<Result>{column("tasks_in_farm_max", &Result::peak_tasks_in_farm,
                                           "largest number of tasks in the farm at one time")},
                    {base::lift_columns<Result>(
                        Columns<Peaks>{column("database_feelers_max", &Peaks::feelers,
                                              "largest number of stored feelers"),
                                       column("database_heap_max", &Peaks::heap,
                                              "largest number of rays in the priority queue"),
                                       column("database_later_max", &Peaks::later,
                                              "largest number of stored rays beyond the limits")},
                        &Result::peaks)});
}

}  // namespace

std::vector<Load> find_loads(const Result& result) {
  if (result.use.time_s <= 0) return {};
  return ray_tracing::find_loads(
      result.use, load_of_coordination(result),
      {"tasks", result.drain_s / result.time_s, fmt::format("all {} handed out", result.tasks)});
}

Columns<Measured> make_columns() {
  const auto of_run = [](const auto& columns) {
    return base::lift_columns<Measured>(columns, &Measured::run);
  };
  return base::join(
      of_run(ray_tracing::speed_columns()),
      {of_run(ray_tracing::ray_columns()),
       of_run(task_columns()),
       of_run(ray_tracing::time_columns()),
       {column<Measured>(
           "drain_s", [](const Measured& m) { return m.run.drain_s; },
           "part of time_s after the last task was handed out")},
       of_run(ray_tracing::stage_columns()),
       of_run(message_columns()),
       base::lift_columns<Measured>(ray_tracing::busy_columns(), &Measured::busy),
       base::lift_columns<Measured>(ray_tracing::bottleneck_columns(), &Measured::loads),
       of_run(base::lift_columns<Result>(ray_tracing::model_columns(), &Result::use)),
       of_run(peak_columns()),
       base::lift_columns<Measured>(snapshots::figure_columns(), &Measured::growth),
       base::lift_columns<Measured>(ray_tracing::data_columns(), &Measured::data)});
}

programs::Shows make_shows() {
  const auto coordinator = to_string(Role::coordinator);
  return {.summary = {"rays", "time_s", "time_per_ray_ms", "speedup", "efficiency",
                      "cpu_busy_worker_mean", "cpu_busy_coordinator", "cpu_busy_database",
                      "link_busy_max", "bottleneck"},
          .loads = {"time_s", "mean_distance", "mean_depth", "messages_sent", "bytes_sent",
                    "cpu_busiest", "cpu_busy_max", "link_busiest", "link_busy_max", "bottleneck",
                    "busiest", "busiest_busy", "next_busiest", "next_busy"},
          .plots = {{"time_s", "Time"},
                    {"time_per_ray_ms", "Time per ray"},
                    {"speedup", "Speed-up"},
                    {"efficiency", "Efficiency"}},
          .network = {{.name = &worker_name,
                       .outsiders = {{coordinator},
                                     {to_string(Role::database), coordinator},
                                     {to_string(Role::display), coordinator}}}}};
}

}  // namespace farm
