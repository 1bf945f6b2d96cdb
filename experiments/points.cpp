#include "experiments/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "experiments/farm_run.hpp"
#include "experiments/jobs.hpp"
#include "experiments/machine_model.hpp"
#include "experiments/pattern_run.hpp"
#include "experiments/progress.hpp"
#include "experiments/results.hpp"
#include "experiments/simulate.hpp"
#include "experiments/trace_files.hpp"
#include "renderer/load.hpp"
#include "simulator/machine/faults.hpp"

namespace experiments {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

// Axes that another key makes void would give rows that say one thing and are another.
void check_axes(const ExperimentFile& file) {
  for (const auto& [axis, key, has_number] :
       {std::tuple("workers", "network.topology", &has_own_workers),
        std::tuple("objects", "scene.source", &has_own_objects)})
    for (const auto& point : file.points)
      if (std::ranges::find(file.axes, axis) != file.axes.end() && has_number(point.experiment))
        throw machine::InvalidInput(fmt::format(
            "{}: [sweep] has an axis {}, but {} says how many itself", file.path, axis, key));
}

void check_farm_point(const Experiment& e, std::set<std::string>& scenes) {
  renderer::check(e.farm.image);
  farm::check(e.farm);
  if (scenes.insert(scene_source(e)).second) renderer::load_scene(scene_source(e));
}

// Names in checks that no column has: known as soon as one point is.
void check_first(const CheckPlan& plan, const ExperimentFile& file, std::size_t index,
                 const ordered_json& result) {
  const ExperimentFile alone{file.path, {}, file.axes, {file.points[index]}, {}, {}};
  const Table table = make_table(alone, {result});
  check_names(plan, alone, 0, table, table.rows[0]);
}

ordered_json run_program(const RunOptions& options, const Experiment& experiment,
                         const fs::path& folder, const std::string& image, observe::Watch& watch) {
  if (experiment.program != "farm") return run_pattern_point(experiment, watch);
  return run_farm_point(experiment, image.empty() ? "" : (folder / image).string(), options.profile,
                        watch);
}

ordered_json run_point(const RunOptions& options, const Point& point, const fs::path& folder,
                       const std::string& image) {
  const Experiment& experiment = point.experiment;
  const std::string title =
      point.at.empty() ? experiment.title : fmt::format("{}: {}", experiment.title, name_of(point));
  TraceFiles files(options);
  const auto save = [&] { files.save(title); };
  try {
    auto result = run_program(options, experiment, folder, image, files.watch());
    save();
    return result;
  } catch (const machine::Fault&) {
    try {
      save();
    } catch (const std::exception&) {  // the fault is what matters
    }
    throw;
  }
}

}  // namespace

void check_points(const RunOptions& options, const ExperimentFile& file) {
  check_trace_files(options, file.points.size(), results_folder(options));
  check_axes(file);
  std::set<std::string> models, scenes, topologies;
  for (const auto& point : file.points) {
    const Experiment& e = point.experiment;
    if (is_farm(file)) check_farm_point(e, scenes);
    if (models.insert(model_key(e)).second) try {
        make_model(e);
      } catch (const machine::InvalidInput& error) {
        throw machine::InvalidInput(fmt::format("{}: {}", file.path, error.what()));
      }
    if (topologies.insert(fmt::format("{} {}", e.topology, e.workers)).second) make_workers(e);
  }
}

std::vector<ordered_json> run_points(const RunOptions& options, const ExperimentFile& file,
                                     const CheckPlan& plan, const fs::path& folder,
                                     const std::vector<std::string>& images) {
  Progress bar("simulating");
  auto job = [&](std::size_t i) {
    const Point& point = file.points[i];
    try {
      return run_point(options, point, folder, images[i]).dump();
    } catch (const std::exception& error) {
      if (file.axes.empty()) throw;
      throw JobFailed(fmt::format("at {}: {}", name_of(point), error.what()), exit_code_of(error));
    }
  };
  std::vector<ordered_json> results;
  for (const auto& text :
       run_jobs(file.points.size(), options.jobs, job,
                [&](std::size_t done, std::size_t index, const std::string&result) {
                  bar.show(done, file.points.size());
                  if (done > 1 || plan.is_empty()) return;
                  const auto first = ordered_json::parse(result);
                  if (is_complete(first)) check_first(plan, file, index, first);
                }))
    results.push_back(text.empty() ? ordered_json() : ordered_json::parse(text));
  return results;
}

bool is_complete(const ordered_json& result) {
  return result["ended"] == "done" || result["ended"] == "saturated";
}

std::string describe_end(const std::vector<ordered_json>& results, std::size_t points) {
  std::map<std::string, std::size_t> counts;
  for (const auto& result : results) ++counts[result["ended"].get<std::string>()];
  if (counts["done"] == points)
    return points == 1 ? "done" : fmt::format("all {} points are done", points);
  std::string text = fmt::format("{} of {} points are done", counts["done"], points);
  for (const auto& [why, meaning] : {std::pair("saturated", "saturated: queues grow without bound"),
                                     std::pair("limit", "cut short at the time limit"),
                                     std::pair("interrupt", "cut short by the user")})
    if (counts[why] > 0) text += fmt::format(", {} {}", counts[why], meaning);
  if (results.size() < points) text += fmt::format(", {} not started", points - results.size());
  return text;
}

}  // namespace experiments
