#include "experiments/simulate.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <set>

#include "experiments/farm_run.hpp"
#include "experiments/files.hpp"
#include "experiments/points.hpp"
#include "experiments/results.hpp"
#include "experiments/run_record.hpp"
#include "experiments/run_report.hpp"
#include "simulator/machine/faults.hpp"

namespace experiments {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

// The first point of each image saves it; stems are made different by a number where they clash.
std::vector<std::string> choose_images(const ExperimentFile& file) {
  std::vector<std::string> paths(file.points.size());
  if (!is_farm(file)) return paths;
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

// The image does not depend on topology, number of processors or timing.
void check_images(const ExperimentFile& file, const std::vector<ordered_json>& results) {
  std::map<std::string, std::uint64_t> hashes;
  if (!is_farm(file)) return;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!is_complete(results[i])) continue;
    const auto hash = results[i]["image_hash"].get<std::uint64_t>();
    const auto [known, added] = hashes.emplace(image_key(file.points[i].experiment), hash);
    machine::check_equal("image of one scene from another machine", hash, known->second);
  }
}

}  // namespace

fs::path results_folder(const RunOptions& options) {
  if (!options.output.empty()) return options.output;
  return fs::path("results") / fs::path(options.file).stem();
}

// Those that were run: not all, if the user interrupted.
static void keep_points_that_ran(Simulation& s) {
  ExperimentFile file = s.file;
  file.points.clear();
  std::vector<ordered_json> results;
  std::vector<std::string> images;
  for (std::size_t i = 0; i < s.results.size(); ++i) {
    if (s.results[i].is_null()) continue;
    file.points.push_back(s.file.points[i]);
    results.push_back(std::move(s.results[i]));
    images.push_back(s.images[i]);
  }
  s.file = std::move(file);
  s.results = std::move(results);
  s.images = std::move(images);
}

Simulation simulate(const RunOptions& options, const ExperimentFile& file, const CheckPlan& plan) {
  const auto start = std::chrono::steady_clock::now();
  check_points(options, file);
  ResultsFolder folder(results_folder(options));
  Simulation s;
  s.file = file;
  s.host_speeds = measure_host(s.file);
  s.images = choose_images(file);
  s.results = run_points(options, s.file, plan, folder.working(), s.images);
  keep_points_that_ran(s);
  check_images(s.file, s.results);
  s.table = make_table(s.file, s.results);
  s.checks = eval_checks(plan, s.file, s.table);
  s.complete =
      s.results.size() == file.points.size() && std::ranges::all_of(s.results, is_complete);
  s.ended = describe_end(s.results, file.points.size());
  s.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  write_file(folder.working() / "results.csv", to_csv(s.table));
  if (!s.checks.empty())
    write_file(folder.working() / "checks.csv", to_csv(make_checks_csv(s.checks, s.table)));
  write_file(folder.working() / "run.json", make_run_json(options, s));
  write_report(folder.working(), options, s);
  folder.commit();
  return s;
}

}  // namespace experiments
