#include "experiments/laboratory/points/farm_run.hpp"

#include <cmath>
#include <ctime>
#include <filesystem>
#include <set>

#include "base/errors.hpp"
#include "experiments/laboratory/host/hash.hpp"
#include "experiments/laboratory/host/try_twice.hpp"
#include "experiments/laboratory/points/data_row.hpp"
#include "experiments/laboratory/points/farm_row.hpp"
#include "experiments/laboratory/points/machine_model.hpp"
#include "renderer/files/load.hpp"

namespace laboratory {

namespace {

using nlohmann::ordered_json;

// Saves an image in a file named by its content, unless it is there: equal images are one file.
std::string save_image(const std::filesystem::path& folder, const renderer::Samples& samples) {
  const auto& sums = samples.sums;
  const auto hash =
      hash_of({reinterpret_cast<const char*>(sums.data()), sums.size() * sizeof sums[0]});
  const auto name = fmt::format("{}-{}x{}.png", hash, samples.width, samples.height);
  try_twice([&] {
    std::filesystem::create_directories(folder);
    if (!std::filesystem::exists(folder / name)) renderer::save_png(folder / name, samples);
  });
  return name;
}

// CPU time of this process: other programs on the host do not count.
double process_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

topologies::Topology make_network(const Experiment& experiment) {
  const std::string& name = experiment.topology;
  const auto n = experiment.workers;
  if (has_own_workers(experiment)) return topologies::make_topology(name);
  if (name == "mesh" || name == "torus") {
    auto rows = static_cast<std::int64_t>(std::sqrt(static_cast<double>(n)));
    while (n % rows != 0) --rows;
    return topologies::make_topology(fmt::format("{}:{}x{}", name, rows, n / rows));
  }
  if (name == "hypercube") {
    int dimensions = 0;
    while ((std::int64_t{1} << dimensions) < n) ++dimensions;
    if ((std::int64_t{1} << dimensions) != n || dimensions > topologies::PORTS)
      throw base::BadInput(
          fmt::format("network.workers: found {}, expected 1, 2, 4, 8 or 16 for a hypercube (more "
                      "need more than four links a processor)",
                      n));
    return topologies::make_topology(fmt::format("hypercube:{}", dimensions));
  }
  // The smallest rings are lines.
  if (name == "ring" && n < 3) return topologies::make_topology(fmt::format("line:{}", n));
  return topologies::make_topology(fmt::format("{}:{}", name, n));
}

}  // namespace

topologies::Topology make_workers(const Experiment& experiment) {
  auto topology = make_network(experiment);
  std::set<std::pair<int, int>> links;
  for (const auto& link : topology.links) links.emplace(link.a.processor, link.b.processor);
  if (experiment.switches > 0)
    for (const auto& link : links) topology.switches[link] = experiment.switches;
  for (const auto& [a, b, count] : experiment.switches_between) {
    if (!links.contains(std::minmax(a, b)))
      throw base::BadInput(
          fmt::format("network.switches: found [{}, {}, {}], but no link of {} joins {} and {}", a,
                      b, count, topology.name, a, b));
    topology.switches[std::minmax(a, b)] = count;
  }
  return topology;
}

bool has_own_workers(const Experiment& experiment) {
  return experiment.topology.find_first_of(":./") != std::string::npos;
}

bool has_own_objects(const Experiment& experiment) { return experiment.scene != "spheres"; }

std::string scene_source(const Experiment& experiment) {
  if (has_own_objects(experiment)) return experiment.scene;
  return fmt::format("spheres:{}", experiment.objects);
}

// Generated spheres stand on a floor that is not counted.
std::int64_t scene_objects(const Experiment& experiment, const renderer::Scene& scene) {
  const auto all = static_cast<std::int64_t>(object_count(scene));
  return scene_source(experiment).starts_with("spheres:") ? all - 1 : all;
}

ordered_json describe_farm(const Experiment& experiment) {
  const auto topology = make_workers(experiment);
  return {{"topology", topology.name},
          {"workers", topology.processors},
          {"objects", scene_objects(experiment, renderer::load_scene(scene_source(experiment)))}};
}

ordered_json run_farm_point(const Experiment& experiment, const std::filesystem::path& images,
                            bool profile, observe::Watch& watch) {
  const double start_s = process_cpu_s();
  const auto model = make_model(experiment);
  const auto topology = make_workers(experiment);
  const auto scene = renderer::load_scene(scene_source(experiment));
  farm::Params params = experiment.farm;
  params.profile = profile;
  params.watch = &watch;

  const double run_start_s = process_cpu_s();
  const bool shares = experiment.data.cache_percent > 0;
  ordered_json data_row = experiment.has_data ? make_empty_data_row() : ordered_json::object();
  const farm::Result result = [&] {
    if (!shares) return farm::run_farm(model, topology, scene, params);
    auto shared = farm::run_shared_farm(model, topology, scene, params, experiment.data);
    data_row = make_data_row(shared);
    return std::move(shared.farm);
  }();
  const double run_s = process_cpu_s() - run_start_s;

  ordered_json keys = ordered_json::array();
  for (const auto& key : result.key_images)
    keys.push_back(
        {{"file", save_image(images, key.samples)}, {"at_s", key.at.value - result.setup_s}});
  ordered_json row = make_farm_row(result);
  row.update(data_row);
  return {{"topology", topology.name},
          {"workers", topology.processors},
          {"objects", scene_objects(experiment, scene)},
          {"row", row},
          {"ended", machine::to_string(result.end)},
          {"key_images", keys},
          {"use", make_farm_use(result)},
          {"image", save_image(images, result.samples)},
          {"host",
           {{"total_s", process_cpu_s() - start_s},
            {"run_s", run_s},
            {"kernel_s", profile && !shares ? ordered_json(result.kernel_host_s) : ordered_json()},
            {"events", result.events}}}};
}

}  // namespace laboratory
