#include "simulator/farm/measured.hpp"

#include "topologies/graph/metrics.hpp"

namespace farm {

using base::column;
using base::Columns;

namespace {

bool is_worker(const observe::CpuRow& cpu) { return cpu.role == Role::worker; }

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

Load load_of_workers(const observe::Use& use) {
  double busy_s = 0, high_s = 0, n = 0;
  for (const auto& cpu : use.cpus)
    if (is_worker(cpu)) {
      busy_s += cpu.busy_s;
      high_s += cpu.busy_high_s;
      ++n;
    }
  return {"workers", busy_s / n / use.time_s,
          fmt::format("tasks {}, routing {}", percent((busy_s - high_s) / n / use.time_s),
                      percent(high_s / n / use.time_s))};
}

Load load_of_routing(const observe::Use& use) {
  const observe::CpuRow* most = nullptr;
  for (const auto& cpu : use.cpus)
    if (is_worker(cpu) && (!most || cpu.busy_high_s > most->busy_high_s)) most = &cpu;
  const double tasks_s = most->busy_s - most->busy_high_s;
  return {most->name + " (routing)", most->busy_high_s / use.time_s,
          fmt::format("beside tasks {}", percent(tasks_s / use.time_s))};
}

Load load_of_coordination(const observe::Use& use) {
  const auto& cpu = *find_role(use, Role::coordinator);
  const auto& process = find_process(use, cpu.name + ".coordination");
  return {"coordination", 1 - process.alternative_s / use.time_s,
          fmt::format("its CPU {}, waiting to send {}, for replies {}",
                      percent(cpu.busy_s / use.time_s), percent(process.output_s / use.time_s),
                      percent(process.input_s / use.time_s))};
}

Load load_of_links(const observe::Use& use) {
  const auto& link = *std::ranges::max_element(use.links, {}, &observe::LinkRow::busy_s);
  return {fmt::format("link {}>{}", link.from, link.to), link.busy_s / use.time_s,
          fmt::format("{} messages, {} bytes", link.messages, link.bytes)};
}

void add_workers(Busy& busy, const observe::Use& use) {
  std::size_t n = 0;
  for (const auto& cpu : use.cpus)
    if (cpu.role == Role::worker) {
      busy.worker_mean += cpu.busy_s / use.time_s;
      busy.worker_max = std::max(busy.worker_max, cpu.busy_s / use.time_s);
      busy.worker_memory = std::max(busy.worker_memory, cpu.memory_peak_bytes);
      ++n;
    }
  busy.worker_mean /= static_cast<double>(n);
}

Busy make_busy(const observe::Use& use) {
  const auto share_of = [&](const char* role) {
    const auto* cpu = observe::find_role(use, role);
    return cpu ? std::optional(cpu->busy_s / use.time_s) : std::nullopt;
  };
  const auto& cpu = *std::ranges::max_element(use.cpus, {}, &observe::CpuRow::busy_s);
  const auto& link = *std::ranges::max_element(use.links, {}, &observe::LinkRow::busy_s);
  Busy busy;
  add_workers(busy, use);
  busy.coordinator = share_of(Role::coordinator);
  busy.database = share_of(Role::database);
  busy.display = share_of(Role::display);
  busy.cpu_busiest = cpu.name;
  busy.cpu_max = cpu.busy_s / use.time_s;
  busy.cpu_high = cpu.busy_high_s / use.time_s;
  busy.link_busiest = link.from + ">" + link.to;
  busy.link_max = link.busy_s / use.time_s;
  busy.link_messages = link.messages;
  busy.link_bytes = link.bytes;
  return busy;
}

Columns<Result> task_columns() {
  using R = Result;
  return {column("tasks", &R::tasks, "rays, or blocks, that were handed out"),
          column("kernel_cycles", &R::kernel_cycles, "cycles that the workers' tasks were charged"),
          column("interactive_s", &R::interactive_s, "part of time_s in the interactive phase"),
          column("reorder_pause_s", &R::reorder_pause_s,
                 "the longest while the ray database classified all rays again, for a stage or an "
                 "order")};
}

Columns<Result> message_columns() {
  using R = Result;
  const auto distance = [](const R& r) {
    return topologies::eval_metrics(r.topology).mean_distance;
  };
  return base::join(
      Columns<R>{column<R>("mean_distance", distance, "links between two workers, on average"),
                 column("mean_depth", &R::mean_depth,
                        "links from the coordinator to a worker, on average")},
      {base::lift_columns<R>(observe::message_columns(), &R::use)});
}

Columns<Busy> busy_columns() {
  using B = Busy;
  return {column("cpu_busy_worker_mean", &B::worker_mean, "share of time_s, mean of the workers"),
          column("cpu_busy_worker_max", &B::worker_max, "share of time_s of the busiest worker"),
          column("cpu_busy_coordinator", &B::coordinator, "share of time_s of the coordinator"),
          column("cpu_busy_database", &B::database, "share of time_s of the ray database"),
          column("cpu_busy_display", &B::display, "share of time_s of the display"),
          column("cpu_busiest", &B::cpu_busiest, "processor that was busy for longest"),
          column("cpu_busy_max", &B::cpu_max, "share of time_s of the busiest processor"),
          column("cpu_busiest_high", &B::cpu_high, "its processes of high priority, as a share"),
          column("link_busy_max", &B::link_max, "share of time_s of the busiest link direction"),
          column("link_busiest", &B::link_busiest, "link direction that was busy for longest"),
          column("link_busiest_messages", &B::link_messages, "messages that it carried"),
          column("link_busiest_bytes", &B::link_bytes, "bytes that it carried"),
          column("worker_memory_bytes", &B::worker_memory, "the most memory that a worker used")};
}

Columns<Measured> bottleneck_columns() {
  using M = Measured;
  const auto load = [](const std::string& name, std::size_t place, auto member,
                       const std::string& help) {
    const auto get = [=](const M& m) {
      return (place < m.loads.size() ? m.loads[place] : Load{"none", 0, ""}).*member;
    };
    return column<M>(name, get, help);
  };
  const auto bottleneck = [](const M& m) {
    return m.loads.empty() || m.loads[0].busy < SATURATED ? "none" : m.loads[0].resource;
  };
  return {
      column<M>("bottleneck", bottleneck, "what limits the farm: `busiest`, if it is saturated"),
      load("busiest", 0, &Load::resource, "resource of the farm that was busy for longest"),
      load("busiest_busy", 0, &Load::busy, "its share of time_s"),
      load("next_busiest", 1, &Load::resource, "resource that was busy for longest but one"),
      load("next_busy", 1, &Load::busy, "its share of time_s")};
}

Columns<Result> peak_columns() {
  using Peaks = RayStores::Peaks;
  return base::join(
      Columns<Result>{column("tasks_in_farm_max", &Result::peak_tasks_in_farm,
                             "tasks with the workers at one time, at most")},
      {base::lift_columns<Result>(
          Columns<Peaks>{
              column("database_feelers_max", &Peaks::feelers, "feelers stored, at most"),
              column("database_heap_max", &Peaks::heap, "rays in the priority queue, at most"),
              column("database_later_max", &Peaks::later, "rays beyond the limits, at most")},
          &Result::peaks)});
}

}  // namespace

std::vector<Load> find_loads(const Result& result) {
  const auto& use = result.use;
  if (use.time_s <= 0) return {};
  std::vector<Load> loads{load_of_workers(use), load_of_routing(use), load_of_coordination(use)};
  for (const char* role : {Role::database, Role::display})
    if (const auto* cpu = find_role(use, role))
      loads.push_back({cpu->name, cpu->busy_s / use.time_s, "its CPU"});
  loads.push_back(load_of_links(use));
  loads.push_back(
      {"tasks", result.drain_s / result.time_s, fmt::format("all {} handed out", result.tasks)});
  std::ranges::stable_sort(loads, std::ranges::greater{}, &Load::busy);
  return loads;
}

Measured::Measured(Result result, tracing::DataFigures data_figures)
    : run(std::move(result)),
      data(std::move(data_figures)),
      busy(make_busy(run.use)),
      loads(find_loads(run)) {}

Columns<Measured> make_columns() {
  const auto of_run = [](const auto& columns) {
    return base::lift_columns<Measured>(columns, &Measured::run);
  };
  return base::join(of_run(tracing::speed_columns()),
                    {of_run(tracing::ray_columns()),
                     of_run(task_columns()),
                     of_run(tracing::time_columns()),
                     {column<Measured>(
                         "drain_s", [](const Measured& m) { return m.run.drain_s; },
                         "part of time_s after the last task was handed out")},
                     of_run(tracing::stage_columns()),
                     of_run(message_columns()),
                     base::lift_columns<Measured>(busy_columns(), &Measured::busy),
                     bottleneck_columns(),
                     of_run(peak_columns()),
                     base::lift_columns<Measured>(growth::figure_columns(), &Measured::growth),
                     base::lift_columns<Measured>(tracing::data_columns(), &Measured::data)});
}

}  // namespace farm
