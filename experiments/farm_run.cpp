#include "experiments/farm_run.hpp"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <set>

#include "experiments/hash.hpp"
#include "experiments/machine_model.hpp"
#include "renderer/load.hpp"
#include "simulator/machine/faults.hpp"

namespace experiments {

namespace {

using nlohmann::ordered_json;

// Saves an image in a file named by its content, unless it is there: equal images are one file.
std::string save_image(const std::filesystem::path& folder, const renderer::Samples& samples) {
  const auto& sums = samples.sums;
  const auto hash =
      hash_of({reinterpret_cast<const char*>(sums.data()), sums.size() * sizeof sums[0]});
  const auto name = fmt::format("{}-{}x{}.png", hash, samples.width, samples.height);
  std::filesystem::create_directories(folder);
  if (!std::filesystem::exists(folder / name)) renderer::save_png(folder / name, samples);
  return name;
}

struct Busy {
  double mean = 0, max = 0;
};

Busy busy_workers(const observe::Use& use) {
  Busy busy;
  std::size_t n = 0;
  for (const auto& cpu : use.cpus)
    if (cpu.name.starts_with("worker")) {
      busy.mean += cpu.busy_s / use.time_s;
      busy.max = std::max(busy.max, cpu.busy_s / use.time_s);
      ++n;
    }
  busy.mean /= static_cast<double>(n);
  return busy;
}

// Shares of the time that each processor and each link direction was busy.
ordered_json use_json(const observe::Use& use) {
  ordered_json cpus, links;
  for (const auto& cpu : use.cpus)
    cpus[cpu.name] = {{"busy", cpu.busy_s / use.time_s},
                      {"busy_high", cpu.busy_high_s / use.time_s},
                      {"preemptions", cpu.preemptions},
                      {"memory_peak_bytes", cpu.memory_peak_bytes}};
  for (const auto& link : use.links)
    links[link.from + ">" + link.to] = {
        {"busy", link.busy_s / use.time_s}, {"messages", link.messages}, {"bytes", link.bytes}};
  return {{"cpus", cpus}, {"links", links}};
}

// CPU time of this process: other programs on the host do not count.
double host_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

ordered_json make_row(const farm::Result& r) {
  const double rays = static_cast<double>(r.rays.total());
  const auto& use = r.use;
  auto busy = [&](const char* name) { return find_cpu(use, name).busy_s / use.time_s; };
  const Busy workers = busy_workers(use);
  const auto busiest = std::ranges::max_element(use.links, {}, &observe::LinkRow::busy_s);
  std::uint64_t memory = 0;
  for (const auto& cpu : use.cpus)
    if (cpu.name.starts_with("worker")) memory = std::max(memory, cpu.memory_peak_bytes);
  return {{"time_s", r.time_s},
          {"time_per_ray_ms", r.time_s / rays * 1e3},
          {"speedup", nullptr},
          {"efficiency", nullptr},
          {"rays", r.rays.total()},
          {"rays_primary", r.rays.primary},
          {"rays_reflected", r.rays.reflected},
          {"rays_transmitted", r.rays.transmitted},
          {"rays_shadow", r.rays.shadow},
          {"interactive_s", r.interactive_s},
          {"setup_s", r.setup_s},
          {"messages", total_messages(use)},
          {"message_bytes", total_bytes(use)},
          {"cpu_busy_worker_mean", workers.mean},
          {"cpu_busy_worker_max", workers.max},
          {"cpu_busy_coordinator", busy("coordinator")},
          {"cpu_busy_database", busy("database")},
          {"cpu_busy_display", busy("display")},
          {"link_busy_max", busiest->busy_s / use.time_s},
          {"link_busiest", busiest->from + ">" + busiest->to},
          {"rays_in_farm_max", r.peak_rays_in_farm},
          {"database_feelers_max", r.peaks.feelers},
          {"database_heap_max", r.peaks.heap},
          {"database_later_max", r.peaks.later},
          {"worker_memory_bytes", memory},
          {"ended", machine::to_string(r.end)}};
}

}  // namespace

namespace {

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
    if ((std::int64_t{1} << dimensions) != n)
      throw machine::InvalidInput(
          fmt::format("network.workers: found {}, expected a power of two for a hypercube", n));
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
      throw machine::InvalidInput(
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

ordered_json run_farm_point(const Experiment& experiment, const ImageFiles& images, bool profile,
                            observe::Watch& watch) {
  const double start_s = host_cpu_s();
  const auto model = make_model(experiment);
  const auto topology = make_workers(experiment);
  const auto scene = renderer::load_scene(scene_source(experiment));
  farm::Params params = experiment.farm;
  params.profile = profile;
  params.watch = &watch;

  const double run_start_s = host_cpu_s();
  const farm::Result result = farm::run_farm(model, topology, scene, params);
  const double run_s = host_cpu_s() - run_start_s;

  ordered_json keys;
  if (images.key_images) keys = ordered_json::array();
  for (const auto& key : result.key_images)
    if (images.key_images)
      keys.push_back({{"file", save_image(images.folder, key.samples)},
                      {"at_s", key.at.value - result.setup_s}});
  return {{"topology", topology.name},
          {"workers", topology.processors},
          {"objects", scene_objects(experiment, scene)},
          {"row", make_row(result)},
          {"ended", machine::to_string(result.end)},
          {"key_images", keys},
          {"use", use_json(result.use)},
          {"image", save_image(images.folder, result.samples)},
          {"host",
           {{"total_s", host_cpu_s() - start_s},
            {"run_s", run_s},
            {"kernel_s", profile ? ordered_json(result.kernel_host_s) : ordered_json()},
            {"events", result.events}}}};
}

}  // namespace experiments
