#include "simulator/farm/farm.hpp"

#include <algorithm>

#include "renderer/scene/generators.hpp"
#include "tests/benchmarks/machine.hpp"
#include "tests/benchmarks/raw_simgrid.hpp"
#include "topologies/make/generators.hpp"

namespace benchmarks {

namespace {

constexpr int WORKERS = 7, OBJECTS = 200, SIZE = 100;

farm::Result run_farm(observe::RunMonitor* monitor, bool profile, machine::EngineParams engine) {
  static const auto scene = renderer::make_spheres(OBJECTS);
  static const auto workers = topologies::make_topology(fmt::format("tree:{}", WORKERS));
  farm::Params params;
  params.image.width = params.image.height = SIZE;
  params.image.limits.depth = 15;
  return farm::run_farm({.model = model(),
                         .topology = workers,
                         .monitor = monitor,
                         .profile = profile,
                         .engine = std::move(engine)},
                        scene, params);
}

// Records all intervals in which a process occupies a CPU, and all messages on links. The
// activities of a processor are in the order of their starts.
std::vector<Activity> record() {
  observe::Trace trace;
  observe::RunMonitor monitor;
  monitor.trace = &trace;
  run_farm(&monitor, false, machine::EngineParams{});
  std::vector<std::pair<double, Activity>> begun;
  for (const auto& span : trace.spans) {
    if (span.doing == observe::Trace::Doing::switching) continue;
    const int on = static_cast<int>(span.processor);
    begun.push_back({span.from_s, {on, on, span.to_s - span.from_s, 0}});
  }
  for (const auto& t : trace.transfers) {
    const auto& link = trace.links[t.link];
    begun.push_back(
        {t.from_s, {static_cast<int>(link.from), static_cast<int>(link.to), 0, t.bytes}});
  }
  std::ranges::stable_sort(begun, {}, [](const auto& b) { return b.first; });
  std::vector<Activity> activities;
  for (const auto& [at_s, activity] : begun) activities.push_back(activity);
  return activities;
}

// Simulates the farm again. Subtracts the host time of the kernels from that of the simulation,
// because the simulators are compared without the computation of the picture.
Sample simulate(std::uint64_t activities, machine::EngineParams engine) {
  farm::Result result;
  const double cpu_s = time_of([&] { result = run_farm(nullptr, true, engine); });
  return {activities, cpu_s - result.kernel_host_s, result.time_s + result.setup_s, 0};
}

// The recorded activities. The first call records them.
const std::vector<Activity>& activities() {
  static const auto recorded = list_of_child(record);
  return recorded;
}

}  // namespace

void add_farm() {
  const char* name = "activities of the farm, 7 workers";
  for (const Engine& engine : ENGINES)
    add(name, engine.by, [engine](benchmark::State&) {
      return in_child([=, count = activities().size()] { return simulate(count, engine.params); });
    });
  add(name, "simgrid", [](benchmark::State&) {
    return in_child([&all = activities()] { return raw_activities(model(), all); });
  });
}

}  // namespace benchmarks
