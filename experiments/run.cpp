#include "experiments/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <set>
#include <tuple>

#include "experiments/farm_run.hpp"
#include "experiments/files.hpp"
#include "experiments/jobs.hpp"
#include "experiments/plot.hpp"
#include "experiments/progress.hpp"
#include "experiments/results.hpp"
#include "experiments/run_report.hpp"
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

// Rejects what is wrong in any point before the first one runs.
void check_points(const ExperimentFile& file) {
  check_axes(file);
  std::set<std::string> models, scenes, topologies;
  for (const auto& point : file.points) {
    const Experiment& e = point.experiment;
    renderer::check(e.farm.image);
    farm::check(e.farm);
    if (models.insert(e.model).second) machine::load_model(e.model);
    if (scenes.insert(scene_source(e)).second) renderer::load_scene(scene_source(e));
    if (topologies.insert(fmt::format("{} {}", e.topology, e.workers)).second) make_workers(e);
  }
}

// The first point of each image saves it; stems are made different by a number where they clash.
std::vector<std::string> choose_images(const ExperimentFile& file) {
  std::vector<std::string> paths(file.points.size());
  std::set<std::string> keys, names;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    const Experiment& e = file.points[i].experiment;
    if (!keys.insert(image_key(e) + stages_key(e)).second) continue;
    std::string name = image_name(e);
    for (int n = 2; !names.insert(name).second; ++n) name = fmt::format("{}-{}", image_name(e), n);
    paths[i] = name + ".png";
  }
  return paths;
}

// "objects = 200, workers = 3"
std::string name_of(const Point& point) {
  std::string name;
  for (const auto& at : point.at)
    name += fmt::format("{}{} = {}", name.empty() ? "" : ", ", at.axis, at.toml);
  return name;
}

// The image does not depend on topology, number of processors or timing.
void check_images(const ExperimentFile& file, const std::vector<ordered_json>& results) {
  std::map<std::string, std::uint64_t> hashes;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto hash = results[i]["image_hash"].get<std::uint64_t>();
    const auto [known, added] = hashes.emplace(image_key(file.points[i].experiment), hash);
    machine::check_equal("image of one scene from another machine", hash, known->second);
  }
}

void print_profile(const Table& table, const std::vector<ordered_json>& results) {
  fmt::print("\nhost CPU time, microseconds per simulated ray beyond the kernel:\n");
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto& host = results[i]["host"];
    const double rays = results[i]["row"]["rays"].get<double>();
    const double run = host["run_s"].get<double>(), kernel = host["kernel_s"].get<double>();
    fmt::print(
        "  {:>6} {:>3} workers {:>7} objects: {:6.2f} us (kernel {:.2f} us), {:.1f} events\n",
        to_string(table.rows[i][0]), to_string(table.rows[i][1]), to_string(table.rows[i][2]),
        (run - kernel) / rays * 1e6, kernel / rays * 1e6, host["events"].get<double>() / rays);
  }
}

}  // namespace

void run_experiment(const RunOptions& options) {
  const auto start = std::chrono::steady_clock::now();
  const ExperimentFile file = load_experiment(options.file, options.overrides);
  check_points(file);
  const fs::path output = options.output.empty()
                              ? fs::path("results") / fs::path(options.file).stem()
                              : fs::path(options.output);
  ResultsFolder folder(output);

  const auto images = choose_images(file);
  std::vector<ordered_json> results;
  {
    Progress bar("simulating");
    auto job = [&](std::size_t i) {
      const std::string image = images[i].empty() ? "" : (folder.working() / images[i]).string();
      try {
        return run_farm_point(file.points[i].experiment, image, options.profile).dump();
      } catch (const std::exception& error) {
        if (file.axes.empty()) throw;
        throw JobFailed(fmt::format("at {}: {}", name_of(file.points[i]), error.what()),
                        exit_code_of(error));
      }
    };
    for (const auto& text : run_jobs(file.points.size(), options.jobs, job,
                                     [&](std::size_t done) { bar.show(done, file.points.size()); }))
      results.push_back(ordered_json::parse(text));
  }
  check_images(file, results);

  const Table table = make_table(file, results);
  write_file(folder.working() / "results.csv", to_csv(table));
  const double wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_file(folder.working() / "run.json", make_run_json(options, file, table, results, wall_s));
  write_report(folder.working(), options, file, table, results, images);
  folder.commit();

  fmt::print("{}\n{}\n", file.points[0].experiment.title, to_text(table, shown_columns(table)));
  if (options.profile) print_profile(table, results);
  fmt::print("\n{} point(s) in {:.1f} s. Results in {}:\n", table.rows.size(), wall_s,
             output.string());
  fmt::print("  report   {}\n", (output / "report.html").string());
  fmt::print("  table    {}\n", (output / "results.csv").string());
  for (const auto& image : images)
    if (!image.empty()) fmt::print("  image    {}\n", (output / image).string());
  if (fs::exists(output / "plots")) fmt::print("  plots    {}\n", (output / "plots").string());
}

}  // namespace experiments
