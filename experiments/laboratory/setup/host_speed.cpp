#include "experiments/laboratory/setup/host_speed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "renderer/files/load_scene.hpp"
#include "simulator/farm/farm.hpp"
#include "simulator/parallel_radiosity/radiosity.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {
namespace {

constexpr const char* SCENE = "spheres:800";
constexpr int SIZE = 48, SHOTS = 3, REPEATS = 5;  // SIZE: image width and height, pixels

using Kernels = std::vector<kernels::KernelUse>;

// Describes a machine of one worker with timed costs.
programs::Setup make_setup(const machine::Model& model) {
  return {.model = model, .topology = topologies::make_topology("line:1"), .cycles_per_host_s = 1};
}

// Measures a workload of the farm by simulating a machine with one worker. The kernels (the
// numerical code) then run as in an experiment: between events of a simulation, which also uses the
// host's caches.
Kernels run_farm(const machine::Model& model, std::optional<farm::Block> block) {
  farm::Params params;
  params.image.width = params.image.height = SIZE;
  params.block = block;
  return farm::run_farm(make_setup(model), renderer::load_scene(SCENE), params).kernels;
}

// Makes a room: a box of 2 x 2 x 2 m, with a lamp below its ceiling and a screen in the middle.
radiosity::Room make_room() {
  radiosity::Room room;
  room.materials = {{"wall", {0.6, 0.6, 0.6}, {}}, {"lamp", {}, {10, 10, 10}}};
  const auto add = [&](std::vector<renderer::Vec> corners, std::uint32_t material, int divide) {
    auto& face = room.faces.emplace_back();
    face.corners = std::move(corners);
    face.material = material;
    face.along = face.across = divide;
  };
  constexpr int WALL = 8;
  add({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, 0, WALL);
  add({{0, 0, 2}, {0, 2, 2}, {2, 2, 2}, {2, 0, 2}}, 0, WALL);
  add({{0, 0, 0}, {0, 0, 2}, {2, 0, 2}, {2, 0, 0}}, 0, WALL);
  add({{0, 2, 0}, {2, 2, 0}, {2, 2, 2}, {0, 2, 2}}, 0, WALL);
  add({{0, 0, 0}, {0, 2, 0}, {0, 2, 2}, {0, 0, 2}}, 0, WALL);
  add({{2, 0, 0}, {2, 0, 2}, {2, 2, 2}, {2, 2, 0}}, 0, WALL);
  add({{0.7, 0.7, 1.9}, {0.7, 1.3, 1.9}, {1.3, 1.3, 1.9}, {1.3, 0.7, 1.9}}, 1, 2);
  add({{0.4, 0.4, 1}, {1.2, 0.4, 1}, {1.2, 1.2, 1}, {0.4, 1.2, 1}}, 0, 4);
  room.faces.back().two_sided = true;
  return room;
}

Kernels run_radiosity(const machine::Model& model) {
  parallel_radiosity::Params params;
  params.solve.shots = SHOTS;
  return parallel_radiosity::run_radiosity(make_setup(model), make_mesh(make_room(), {}), params)
      .kernels;
}

double eval_speed(const Kernels& kernels) {
  double cycles = 0, host_s = 0;
  for (const auto& kernel : kernels) {
    cycles += static_cast<double>(kernel.counted.value);
    host_s += kernel.host_s;
  }
  return cycles / host_s;
}

struct Workload {
  const char* name;
  Kernels (*run)(const machine::Model& model);
};
constexpr Workload WORKLOADS[] = {
    {"rays", [](const machine::Model& model) { return run_farm(model, {}); }},
    {"blocks",
     [](const machine::Model& model) {
       return run_farm(model, farm::Block{8, 8});
     }},
    {"radiosity", &run_radiosity}};

// Measures the workloads in turn, so that a temporary slowdown of the host affects all of them.
HostSpeed measure(const machine::Model& model) {
  HostSpeed host;
  host.repeats = REPEATS;
  // must be measured before the first job, because child processes inherit the value of this_host()
  host.clock_interval_s = kernels::this_host().interval_s;
  std::vector<double> speeds[std::size(WORKLOADS)];
  for_each_job(
      REPEATS * std::size(WORKLOADS), 1,
      [&](std::size_t i) {
        return fmt::format("{}", eval_speed(WORKLOADS[i % std::size(WORKLOADS)].run(model)));
      },
      [&](const JobEnd& end) {
        if (!end.died.empty()) throw Failure("measuring the host: " + end.died, 1);
        speeds[end.index % std::size(WORKLOADS)].push_back(
            std::strtod(end.result.c_str(), nullptr));
      });
  if (was_interrupted()) throw Interrupted();
  double logarithms = 0;
  for (std::size_t w = 0; w < std::size(WORKLOADS); ++w) {
    auto& all = speeds[w];
    std::ranges::sort(all);
    const double median = all[REPEATS / 2];
    host.workloads.push_back({WORKLOADS[w].name, median, (all.back() - all.front()) / median});
    logarithms += std::log(median);
  }
  host.cycles_per_host_s = std::exp(logarithms / std::size(WORKLOADS));
  const auto [least, most] =
      std::ranges::minmax(host.workloads, {}, &HostSpeed::Workload::cycles_per_host_s);
  host.spread = (most.cycles_per_host_s - least.cycles_per_host_s) / host.cycles_per_host_s;
  return host;
}

}  // namespace

HostSpeeds measure_host(ExperimentFile& file) {
  HostSpeeds speeds;
  for (auto& point : file.points) {
    if (!point.experiment.is_timed) continue;
    const auto key = model_key(point.experiment.model);
    if (!speeds.contains(key)) speeds[key] = measure(make_model(point.experiment.model));
    point.experiment.cycles_per_host_s = speeds[key].cycles_per_host_s;
  }
  return speeds;
}

}  // namespace laboratory
