#include "experiments/laboratory/setup/host_speed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/setup/setup.hpp"
#include "renderer/files/nff.hpp"
#include "simulator/farm/farm.hpp"
#include "topologies/make/generators.hpp"

namespace laboratory {
namespace {

constexpr const char* SCENE = "spheres:800";
constexpr int SIZE = 32, REPEATS = 5;  // pixels a side

// Runs a farm of one worker: the kernel is measured where it will run, between the events of a
// simulation, which share the host's caches with it.
std::string measure_once(const machine::Model& model) {
  farm::Params params;
  params.image.width = params.image.height = SIZE;
  params.profile = true;
  const auto result = farm::run_farm(model, topologies::make_topology("line:1"),
                                     renderer::load_scene(SCENE), params);
  return fmt::format("{}", static_cast<double>(result.kernel_cycles.value) / result.kernel_host_s);
}

HostSpeed measure(const machine::Model& model) {
  std::vector<double> speeds;
  for_each_job(
      REPEATS, 1, [&](std::size_t) { return measure_once(model); },
      [&](const JobEnd& end) {
        if (!end.died.empty()) throw Failure("measuring the host: " + end.died, 1);
        speeds.push_back(std::strtod(end.result.c_str(), nullptr));
      });
  if (was_interrupted()) throw Interrupted();
  std::ranges::sort(speeds);
  const double median = speeds[REPEATS / 2];
  return {median, (speeds.back() - speeds.front()) / median, REPEATS};
}

}  // namespace

HostSpeeds measure_host(ExperimentFile& file) {
  HostSpeeds speeds;
  for (auto& point : file.points) {
    if (!point.experiment.is_timed) continue;
    const auto key = model_key(point.experiment);
    if (!speeds.contains(key)) speeds[key] = measure(make_model(point.experiment));
    point.experiment.cycles_per_host_s = speeds[key].cycles_per_host_s;
  }
  return speeds;
}

}  // namespace laboratory
