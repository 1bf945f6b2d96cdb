#include "experiments/laboratory/points/farm_row.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "simulator/farm/bottleneck.hpp"
#include "topologies/graph/metrics.hpp"

namespace laboratory {

namespace {

using nlohmann::ordered_json;

struct Workers {
  double busy_mean = 0, busy_max = 0;
  std::uint64_t memory = 0;
};

Workers look_at_workers(const observe::Use& use) {
  Workers workers;
  std::size_t n = 0;
  for (const auto& cpu : use.cpus)
    if (cpu.name.starts_with("worker")) {
      workers.busy_mean += cpu.busy_s / use.time_s;
      workers.busy_max = std::max(workers.busy_max, cpu.busy_s / use.time_s);
      workers.memory = std::max(workers.memory, cpu.memory_peak_bytes);
      ++n;
    }
  workers.busy_mean /= static_cast<double>(n);
  return workers;
}

ordered_json time_columns(const farm::Result& r) {
  const auto& rays = r.rays;
  return {{"time_s", r.time_s},
          {"time_per_ray_ms", r.time_s / static_cast<double>(rays.total()) * 1e3},
          {"speedup", nullptr},
          {"efficiency", nullptr},
          {"rays", rays.total()},
          {"rays_primary", rays.primary},
          {"rays_reflected", rays.reflected},
          {"rays_transmitted", rays.transmitted},
          {"rays_shadow", rays.shadow},
          {"tasks", r.tasks},
          {"kernel_cycles", r.kernel_cycles.value},
          {"interactive_s", r.interactive_s},
          {"setup_s", r.setup_s},
          {"total_s", r.setup_s + r.time_s},
          {"drain_s", r.drain_s}};
}

// When the limits of each stage but the last were reached: its key image.
ordered_json stage_columns(const farm::Result& r) {
  ordered_json columns = ordered_json::object();
  for (std::size_t i = 0; i < r.key_images.size(); ++i)
    columns[fmt::format("stage{}_s", i + 1)] = r.key_images[i].at.value - r.setup_s;
  return columns;
}

ordered_json load_columns(const farm::Result& r) {
  const auto& use = r.use;
  // Empty for a processor that the machine does not have.
  auto busy = [&](const char* name) {
    const auto cpu = std::ranges::find(use.cpus, name, &observe::CpuRow::name);
    return cpu != use.cpus.end() ? ordered_json(cpu->busy_s / use.time_s) : ordered_json();
  };
  const Workers workers = look_at_workers(use);
  const auto busiest = std::ranges::max_element(use.cpus, {}, &observe::CpuRow::busy_s);
  const auto link = std::ranges::max_element(use.links, {}, &observe::LinkRow::busy_s);
  return {{"cpu_busy_worker_mean", workers.busy_mean},
          {"cpu_busy_worker_max", workers.busy_max},
          {"cpu_busy_coordinator", busy("coordinator")},
          {"cpu_busy_database", busy("database")},
          {"cpu_busy_display", busy("display")},
          {"cpu_busiest", busiest->name},
          {"cpu_busy_max", busiest->busy_s / use.time_s},
          {"cpu_busiest_high", busiest->busy_high_s / use.time_s},
          {"link_busy_max", link->busy_s / use.time_s},
          {"link_busiest", link->from + ">" + link->to},
          {"link_busiest_messages", link->messages},
          {"link_busiest_bytes", link->bytes},
          {"worker_memory_bytes", workers.memory}};
}

ordered_json bottleneck_columns(const farm::Result& r) {
  auto loads = farm::find_loads(r);
  while (loads.size() < 2) loads.push_back({.resource = "none", .busy = 0, .doing = ""});
  return {{"bottleneck", loads[0].busy < farm::SATURATED ? "none" : loads[0].resource},
          {"busiest", loads[0].resource},
          {"busiest_busy", loads[0].busy},
          {"next_busiest", loads[1].resource},
          {"next_busy", loads[1].busy}};
}

}  // namespace

ordered_json make_farm_row(const farm::Result& r) {
  ordered_json row = time_columns(r);
  row.update(stage_columns(r));
  row.update({{"mean_distance", topologies::eval_metrics(r.topology).mean_distance},
              {"mean_depth", r.mean_depth},
              {"messages", total_messages(r.use)},
              {"message_bytes", total_bytes(r.use)}});
  row.update(load_columns(r));
  row.update(bottleneck_columns(r));
  row.update({{"tasks_in_farm_max", r.peak_tasks_in_farm},
              {"database_feelers_max", r.peaks.feelers},
              {"database_heap_max", r.peaks.heap},
              {"database_later_max", r.peaks.later},
              {"ended", machine::to_string(r.end)}});
  return row;
}

ordered_json make_farm_use(const farm::Result& result) {
  const auto& use = result.use;
  ordered_json cpus, links, loads = ordered_json::array();
  for (const auto& cpu : use.cpus)
    cpus[cpu.name] = {{"busy", cpu.busy_s / use.time_s},
                      {"busy_high", cpu.busy_high_s / use.time_s},
                      {"preemptions", cpu.preemptions},
                      {"memory_peak_bytes", cpu.memory_peak_bytes}};
  for (const auto& link : use.links)
    links[link.from + ">" + link.to] = {
        {"busy", link.busy_s / use.time_s}, {"messages", link.messages}, {"bytes", link.bytes}};
  for (const auto& load : farm::find_loads(result))
    loads.push_back({{"resource", load.resource}, {"busy", load.busy}, {"doing", load.doing}});
  return {{"loads", loads}, {"cpus", cpus}, {"links", links}};
}

}  // namespace laboratory
