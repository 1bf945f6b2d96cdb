#include "simulator/ray_tracing/busy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "simulator/observe/mean.hpp"

namespace ray_tracing {

using base::column;
using base::Columns;

namespace {

// Mean load of the processors with this role, split into work and routing.
Load load_of(const observe::Use& use, Role role, const char* name, const char* work) {
  double busy_s = 0, high_s = 0, n = 0;
  for (const auto& cpu : use.cpus)
    if (has_role(cpu, role)) {
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

// All workers whose processors have the same model.
struct Alike {
  std::string model;
  int count = 0;
  double busy_s = 0;
  std::uint64_t tasks = 0;
};

std::vector<Alike> group_workers(const observe::Use& use) {
  std::vector<Alike> groups;
  for (const auto& cpu : use.cpus) {
    if (!has_role(cpu, Role::worker)) continue;
    auto group = std::ranges::find(groups, cpu.model, &Alike::model);
    if (group == groups.end()) group = groups.insert(groups.end(), {cpu.model});
    ++group->count;
    group->busy_s += cpu.busy_s;
    group->tasks += cpu.tasks.value_or(0);
  }
  return groups;
}

bool routes_for_workers(const observe::Use& use, const observe::CpuRow& cpu) {
  return has_role(cpu, find_role(use, Role::router) ? Role::router : Role::worker);
}

Load load_of_routing(const observe::Use& use) {
  const observe::CpuRow* most = nullptr;
  for (const auto& cpu : use.cpus)
    if (routes_for_workers(use, cpu) && (!most || cpu.busy_high_s > most->busy_high_s)) most = &cpu;
  const double tasks_s = most->busy_s - most->busy_high_s;
  return {most->name + " (routing)", most->busy_high_s / use.time_s,
          fmt::format("beside {} {}", has_role(*most, Role::router) ? "data" : "tasks",
                      percent(tasks_s / use.time_s))};
}

Load load_of_links(const observe::Use& use) {
  const auto& link = *std::ranges::max_element(use.links, {}, &observe::LinkRow::busy_s);
  return {"link " + name_of(link), link.busy_s / use.time_s,
          fmt::format("{} messages, {} bytes", link.messages, link.bytes)};
}

void add_workers(Busy& busy, const observe::Use& use) {
  std::size_t n = 0;
  for (const auto& cpu : use.cpus)
    if (has_role(cpu, Role::worker)) {
      busy.worker_mean += cpu.busy_s / use.time_s;
      busy.worker_max = std::max(busy.worker_max, cpu.busy_s / use.time_s);
      busy.worker_memory = std::max(busy.worker_memory, cpu.memory_peak_bytes);
      ++n;
    }
  busy.worker_mean /= static_cast<double>(n);
}

}  // namespace

std::string to_string(Role role) {
  constexpr const char* NAMES[] = {"coordinator", "worker", "database", "display", "router"};
  return NAMES[static_cast<int>(role)];
}

bool has_role(const observe::CpuRow& cpu, Role role) { return cpu.role == to_string(role); }

const observe::CpuRow* find_role(const observe::Use& use, Role role) {
  const auto found = std::ranges::find(use.cpus, to_string(role), &observe::CpuRow::role);
  return found == use.cpus.end() ? nullptr : &*found;
}

void check_label(const topologies::Topology& topology, int id) {
  const auto label = name_of(topology, id, "");
  for (const Role own : {Role::coordinator, Role::database, Role::display})
    if (label == to_string(own))
      base::refuse("network.topology",
                   "found a processor called \"{1}\" in {0}, expected another name: the program "
                   "uses this one",
                   topology.name, label);
}

Busy make_busy(const observe::Use& use) {
  const auto share_of = [&](Role role) {
    const auto* cpu = find_role(use, role);
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
  busy.link_busiest = name_of(link);
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
          column("cpu_busiest", &B::cpu_busiest, "busiest processor"),
          column("cpu_busy_max", &B::cpu_max, "share of time_s of the busiest processor"),
          column("cpu_busiest_high", &B::cpu_high,
                 "share of time_s of the busiest processor in high-priority processes"),
          column("link_busy_max", &B::link_max, "share of time_s of the busiest link direction"),
          column("link_busiest", &B::link_busiest, "busiest link direction"),
          column("link_busiest_messages", &B::link_messages,
                 "messages over the busiest link direction"),
          column("link_busiest_bytes", &B::link_bytes, "bytes over the busiest link direction"),
          column("worker_memory_bytes", &B::worker_memory, "largest memory that a worker used")};
}

Columns<Busy> router_columns() {
  return base::only_if(
      [](const Busy& busy) { return busy.router_mean.has_value(); },
      Columns<Busy>{column("cpu_busy_router_mean", &Busy::router_mean,
                           "share of time_s, mean of the routing processors of workers")});
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
  return {column<M>("bottleneck", bottleneck,
                    "resource that limits the program: `busiest` if it is saturated, else none"),
          load("busiest", 0, &Load::resource, "resource that was busy for longest"),
          load("busiest_busy", 0, &Load::busy, "share of time_s in which `busiest` was busy"),
          load("next_busiest", 1, &Load::resource, "second busiest resource"),
          load("next_busy", 1, &Load::busy, "share of time_s in which `next_busiest` was busy")};
}

Loads find_loads(const observe::Use& use, const Load& coordination, const Load& tasks) {
  Loads loads = {load_of_workers(use), load_of_routing(use), load_of_links(use)};
  if (find_role(use, Role::router))
    loads.push_back(load_of(use, Role::router, "data managers", "data"));
  loads.push_back(coordination);
  for (const Role role : {Role::database, Role::display})
    if (const auto* cpu = find_role(use, role))
      loads.push_back({cpu->name, cpu->busy_s / use.time_s, "its CPU"});
  loads.push_back(tasks);
  std::ranges::stable_sort(loads, std::ranges::greater{}, &Load::busy);
  return loads;
}

std::vector<std::string> note_models(const observe::Use& use) {
  const auto groups = group_workers(use);
  std::vector<std::string> notes;
  if (groups.size() < 2) return notes;
  const auto tasks = std::transform_reduce(groups.begin(), groups.end(), 0.0, std::plus{},
                                           [](const Alike& g) { return double(g.tasks); });
  for (const auto& [model, count, busy_s, done] : groups) {
    auto note = fmt::format("workers of model {}: {}, busy {} of the time", model, count,
                            percent(busy_s / count / use.time_s));
    if (tasks > 0)
      note += fmt::format(", {:.1f} % of the tasks, {:.1f} % each", 100 * double(done) / tasks,
                          100 * double(done) / tasks / count);
    notes.push_back(std::move(note));
  }
  return notes;
}

Columns<observe::Use> model_columns() {
  const auto is_other = [](const observe::Use& use, const observe::CpuRow& cpu) {
    return has_role(cpu, Role::worker) && cpu.model != find_role(use, Role::coordinator)->model;
  };
  const auto share = [is_other](const observe::Use& use) {
    double others = 0, all = 0;
    for (const auto& cpu : use.cpus) {
      const auto tasks = static_cast<double>(cpu.tasks.value_or(0));
      all += tasks;
      others += is_other(use, cpu) ? tasks : 0;
    }
    return observe::eval_mean(others, all);
  };
  return base::only_if(
      [is_other](const observe::Use& use) {
        return std::ranges::any_of(use.cpus, [&](const auto& cpu) { return is_other(use, cpu); });
      },
      Columns<observe::Use>{column<observe::Use>(
          "other_models_tasks", share,
          "share of the tasks done by workers of other models than the coordinator's")});
}

std::string percent(double share) { return fmt::format("{:.0f} %", 100 * share); }

}  // namespace ray_tracing
