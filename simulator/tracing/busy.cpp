#include "simulator/tracing/busy.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tracing {

using base::column;
using base::Columns;

namespace {

// On average, of the processors of a role.
Load load_of(const observe::Use& use, const char* role, const char* name, const char* work) {
  double busy_s = 0, high_s = 0, n = 0;
  for (const auto& cpu : use.cpus)
    if (cpu.role == role) {
      busy_s += cpu.busy_s;
      high_s += cpu.busy_high_s;
      ++n;
    }
  return {name, busy_s / n / use.time_s,
          fmt::format("{} {}, routing {}", work, percent((busy_s - high_s) / n / use.time_s),
                      percent(high_s / n / use.time_s))};
}

Load load_of_workers(const observe::Use& use) {
  return load_of(use, Role::worker, "workers", "tasks");
}

bool routes_for_workers(const observe::Use& use, const observe::CpuRow& cpu) {
  return cpu.role == (find_role(use, Role::router) ? Role::router : Role::worker);
}

Load load_of_routing(const observe::Use& use) {
  const observe::CpuRow* most = nullptr;
  for (const auto& cpu : use.cpus)
    if (routes_for_workers(use, cpu) && (!most || cpu.busy_high_s > most->busy_high_s)) most = &cpu;
  const double tasks_s = most->busy_s - most->busy_high_s;
  return {most->name + " (routing)", most->busy_high_s / use.time_s,
          fmt::format("beside {} {}", most->role == Role::router ? "data" : "tasks",
                      percent(tasks_s / use.time_s))};
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

}  // namespace

Busy make_busy(const observe::Use& use) {
  const auto share_of = [&](const char* role) {
    const auto* cpu = observe::find_role(use, role);
    return cpu ? std::optional(cpu->busy_s / use.time_s) : std::nullopt;
  };
  const auto& cpu = *std::ranges::max_element(use.cpus, {}, &observe::CpuRow::busy_s);
  const auto& link = *std::ranges::max_element(use.links, {}, &observe::LinkRow::busy_s);
  Busy busy;
  add_workers(busy, use);
  if (find_role(use, Role::router)) busy.router_mean = load_of(use, Role::router, "", "").busy;
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

Columns<Busy> router_columns() {
  return base::only_if(
      [](const Busy& busy) { return busy.router_mean.has_value(); },
      Columns<Busy>{column("cpu_busy_router_mean", &Busy::router_mean,
                           "share of time_s, mean of the processors that route for workers")});
}

Columns<Loads> bottleneck_columns() {
  using M = Loads;
  const auto load = [](const std::string& name, std::size_t place, auto member,
                       const std::string& help) {
    const auto get = [=](const M& m) {
      return (place < m.size() ? m[place] : Load{"none", 0, ""}).*member;
    };
    return column<M>(name, get, help);
  };
  const auto bottleneck = [](const M& m) {
    return m.empty() || m[0].busy < SATURATED ? "none" : m[0].resource;
  };
  return {
      column<M>("bottleneck", bottleneck, "what limits the program: `busiest`, if it is saturated"),
      load("busiest", 0, &Load::resource, "resource that was busy for longest"),
      load("busiest_busy", 0, &Load::busy, "its share of time_s"),
      load("next_busiest", 1, &Load::resource, "resource that was busy for longest but one"),
      load("next_busy", 1, &Load::busy, "its share of time_s")};
}

Loads find_loads(const observe::Use& use) {
  Loads loads = {load_of_workers(use), load_of_routing(use), load_of_links(use)};
  if (find_role(use, Role::router))
    loads.push_back(load_of(use, Role::router, "data managers", "data"));
  return loads;
}

void sort(Loads& loads) { std::ranges::stable_sort(loads, std::ranges::greater{}, &Load::busy); }

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

}  // namespace tracing
