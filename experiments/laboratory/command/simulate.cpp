// Simulates an experiment and writes its results folder.
#include <fmt/format.h>

#include <algorithm>
#include <ranges>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/command/run.hpp"
#include "experiments/laboratory/film/fault_drawings.hpp"
#include "experiments/laboratory/film/recorded_point.hpp"
#include "experiments/laboratory/host/interrupt.hpp"
#include "experiments/laboratory/host/link_files.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/host/results_folder.hpp"
#include "experiments/laboratory/judge/cover.hpp"
#include "experiments/laboratory/judge/ranking.hpp"
#include "experiments/laboratory/points/dictionary.hpp"
#include "experiments/laboratory/points/images.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/points.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/points/single_worker.hpp"
#include "experiments/laboratory/report/run_report.hpp"
#include "experiments/laboratory/setup/open_scene.hpp"
#include "experiments/laboratory/uncertain/confidence.hpp"
#include "experiments/laboratory/uncertain/draw.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t MOST_NAMED = 20;

[[noreturn]] void refuse_missing(const ExperimentFile& file, const fs::path& results,
                                 const std::vector<std::size_t>& missing) {
  std::string text;
  for (const auto i : missing | std::views::take(MOST_NAMED))
    text += fmt::format("\n  {}  {}", i, name_of(file.points[i]));
  throw base::BadInput(fmt::format("{}: {} of {} points are missing:{}{}", results.string(),
                                   missing.size(), file.points.size(), text,
                                   missing.size() > MOST_NAMED ? "\n  ..." : ""));
}

// Simulates the points without records, or throws if `missing` forbids it. Sets `there` to the
// number of points that had records.
Results make_results(const PointsPlan& plan, Missing missing, std::size_t& there) {
  Results results = find_points(plan, all_points(plan.file));
  const auto to_run = missing_points(results);
  there = results.size() - to_run.size();
  if (to_run.empty()) return results;
  if (missing == Missing::refuse) refuse_missing(plan.file, plan.results, to_run);
  run_points(plan, to_run, results);
  const auto nothing = [](const auto& result) {
    return !result.is_there() || (result.is_failed() && result.rows.empty());
  };
  if (std::ranges::all_of(results, nothing))
    throw_failures(plan.file, results,
                   plan.options.runs_anew()
                       ? "only the trace, chart and films of the run so far were written"
                       : "no results were written");
  return results;
}

void check_inputs(const RunOptions& options, const ExperimentFile& file, const fs::path& results) {
  check_recordings(options, file,
                   (static_cast<std::size_t>(file.uncertain.machines) + 1) * file.points.size());
  check_points(options, file);
  warn_of_scenes(file);
  check_same_experiment(results, file);
}

// Drops the points that were not simulated because the user interrupted the run.
void keep_points_that_ran(Simulation& s, const PointsPlan& plan) {
  const auto all = std::move(s.file.points);
  s.file.points.clear();
  Results results;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!s.results[i].is_there()) continue;
    const bool lone = is_lone(all[i].experiment, s.results[i]);
    s.records.push_back((lone ? lone_records_folder() : records_folder()) /
                        (plan.keys[i] + ".json"));
    s.file.points.push_back(all[i]);
    results.push_back(std::move(s.results[i]));
  }
  s.results = std::move(results);
}

// Writes the confidence intervals from the results of all drawn machines. Checks them against the
// experiment's expectations.
void write_confidence(const fs::path& folder, const ExperimentFile& file, const Results& drawn,
                      Simulation& s) {
  const auto confidence = find_confidence(file, s.table, drawn);
  s.left_out = confidence.left_out;
  if (confidence.machines < LEAST_MACHINES) return;
  const auto tables = make_confidence_tables(s.table, confidence);
  save_confidence(folder, tables);
  check_cover(s.checks, s.table, tables);
}

void write_results(const fs::path& folder, const RunOptions& options, Simulation& s) {
  base::save_whole(folder / "results.csv", to_csv(s.table));
  base::save_whole(folder / "results.schema.json", make_dictionary(s.file, s.table).dump(2) + "\n");
  if (!s.checks.empty())
    base::save_whole(folder / "checks.csv",
                     to_csv(guard_formulas(make_checks_csv(s.checks, s.table))));
  save_run_json(folder, options, s);
  s.undrawn = write_report(folder, options, s);
}

}  // namespace

Simulation simulate(const RunOptions& options, const ExperimentFile& file, const CheckPlan& checks,
                    Missing missing) {
  Clock clock;
  const auto results = results_folder(options);
  check_inputs(options, file, results);
  ResultsFolder folder(results);
  const StoreGuard guard(results);
  Simulation s;
  s.file = file;
  s.host_speeds = measure_host(s.file);
  // The points of the file come first. Copies of them follow for each machine that is drawn at
  // random, as the section [uncertain] requests.
  const ExperimentFile all = spread(s.file);
  s.asked = all.points.size();
  PointsPlan plan(options, all, inspect_names(checks, s.file), record_points(s.file),
                  draw_faults(s.file.report.figure.make_style({})));
  check_results_folder(results);  // not earlier: the check needs all inputs
  plan.lone = folder.working() / lone_records_folder();
  folder.fill([&] {
    Results drawn = make_results(plan, missing, s.there);
    measure_single_workers(plan, drawn,
                           missing == Missing::run ? SingleWorker::run : SingleWorker::find);
    s.results.assign(drawn.begin(), drawn.begin() + std::ptrdiff_t(file.points.size()));
    link_files(results / records_folder(), folder.working() / records_folder());
    place_images(s.file, s.results, folder.working() / records_folder(), folder.working());
    keep_points_that_ran(s, plan);
    s.table = make_table(checks, s.file, s.results);
    s.checks = eval_checks(checks, s.file, s.table);
    if (file.uncertain.machines > 0 && !was_interrupted()) {
      write_confidence(folder.working(), file, drawn, s);
      save_rankings(folder.working(), find_rankings(checks, file, all, drawn));
    }
    s.complete = s.results.size() == file.points.size() &&
                 std::ranges::all_of(s.results, &PointResult::is_complete);
    s.ended = describe_end(s.results, file.points.size());
    s.wall_s = clock.lap();
    save_origin(folder.working(), file, plan.origin);
    write_results(folder.working(), options, s);
  });
  folder.commit([&](const fs::path& older) { check_same_experiment(older, file); });
  return s;
}

}  // namespace laboratory
