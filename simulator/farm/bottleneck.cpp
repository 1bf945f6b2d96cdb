#include "simulator/farm/bottleneck.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace farm {

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

}  // namespace farm
