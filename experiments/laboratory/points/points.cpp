#include "experiments/laboratory/points/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "base/errors.hpp"
#include "experiments/laboratory/points/farm_run.hpp"
#include "experiments/laboratory/points/machine_model.hpp"
#include "experiments/laboratory/points/network_setup.hpp"
#include "experiments/laboratory/points/pattern_run.hpp"
#include "experiments/laboratory/points/point_key.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/points/trace_files.hpp"
#include "renderer/files/load.hpp"

namespace laboratory {

namespace {

// Axes that another key makes void would give rows that say one thing and are another.
void check_axes(const ExperimentFile& file) {
  for (const auto& [axis, key, has_number] :
       {std::tuple("workers", "network.topology", &has_own_workers),
        std::tuple("objects", "scene.source", &has_own_objects)})
    for (const auto& point : file.points)
      if (std::ranges::find(file.axes, axis) != file.axes.end() && has_number(point.experiment))
        throw base::BadInput(fmt::format("{}: [sweep] has an axis {}, but {} says how many itself",
                                         file.path, axis, key));
}

using SceneSizes = std::map<std::string, farm::SceneSize>;  // by source

// What [data] says, also where a point has none of its scene's data to share.
void check_data(const Experiment& e, const farm::SceneSize& scene) {
  farm::Params params = e.farm;
  if (is_timed(e)) params.cycles_per_host_s = 1;
  farm::check(make_model(e), scene, params, e.data);
}

void check_farm_point(const Experiment& e, SceneSizes& scenes) {
  renderer::check(e.farm.image);
  farm::check(e.farm);
  if (e.has_data) farm::check_task(e.farm);
  const auto source = scene_source(e);
  if (!scenes.contains(source)) scenes[source] = farm::size_of(renderer::load_scene(source));
  if (e.data.cache_percent > 0) check_data(e, scenes[source]);
}

// What is wrong with it, whichever room says so, is said of the file.
template <class Check>
void check_in(const ExperimentFile& file, const Check& check) {
  const auto refuse = [&](const std::exception& error) {
    throw base::BadInput(fmt::format("{}: {}", file.path, error.what()));
  };
  try {
    check();
  } catch (const std::runtime_error& error) {
    refuse(error);
  } catch (const std::invalid_argument& error) {
    refuse(error);
  }
}

}  // namespace

void check_points(const RunOptions& options, const ExperimentFile& file, std::size_t chosen) {
  check_trace_files(options, chosen, results_folder(options));
  check_axes(file);
  std::set<std::string> models, networks;
  SceneSizes scenes;
  for (const auto& point : file.points)
    check_in(file, [&] {
      const Experiment& e = point.experiment;
      if (is_farm(file))
        check_farm_point(e, scenes);
      else
        check_pattern_point(e);
      if (models.insert(model_key(e)).second) make_model(e);
      if (networks.insert(network_key(e)).second) check_network(e);
    });
}

}  // namespace laboratory
