#include <fmt/format.h>

#include <algorithm>

#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/points/farm_run.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/pattern_run.hpp"
#include "experiments/laboratory/points/point_key.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/points.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/points/trace_files.hpp"
#include "simulator/machine/faults.hpp"

namespace laboratory {

namespace {

using nlohmann::ordered_json;

ordered_json run_program(const PointsPlan& plan, std::size_t number, observe::Watch& watch) {
  const Experiment& experiment = plan.file.points[number].experiment;
  const auto images = plan.results / records_folder();
  if (experiment.program != "farm") return run_pattern_point(experiment, images, watch);
  return run_farm_point(experiment, images, plan.options.profile, watch);
}

ordered_json run_point(const PointsPlan& plan, std::size_t number) {
  const Point& point = plan.file.points[number];
  const auto& title = point.experiment.title;
  TraceFiles files(plan.options);
  const auto save = [&] {
    files.save(point.at.empty() ? title : fmt::format("{}: {}", title, name_of(point)));
  };
  try {
    auto result = run_program(plan, number, files.watch());
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

void save_point(const PointsPlan& plan, std::size_t number, ordered_json result) {
  const Point& point = plan.file.points[number];
  const bool lone = is_lone(point.experiment, result);
  if (lone && plan.lone.empty()) return;
  result["at"] = name_of(point);
  if (!lone) save_origin(plan.results, plan.origin);
  save_record(lone ? plan.lone : plan.results / records_folder(), plan.keys[number],
              std::move(result));
}

// In the child: a failure is a result too, bad input is not.
ordered_json run_and_save(const PointsPlan& plan, std::size_t number) {
  const Point& point = plan.file.points[number];
  try {
    auto result = run_point(plan, number);
    save_point(plan, number, result);  // first: a name mistyped in the file costs no result
    if (plan.inspect) plan.inspect(point, result);
    result.erase("use");
    return result;
  } catch (const std::exception& error) {
    auto failure = make_failure(error);
    if (!failure.is_null()) return failure;
    if (plan.file.axes.empty()) throw;
    throw JobFailed(fmt::format("at {}: {}", name_of(point), error.what()), exit_code_of(error));
  }
}

void finish_failure(const PointsPlan& plan, std::size_t number, ordered_json& failure,
                    Progress& bar) {
  const Point& point = plan.file.points[number];
  if (!plan.file.axes.empty())
    bar.say(fmt::format("tlab: at {}: {}", name_of(point), failure["message"].get<std::string>()));
  add_axes(point.experiment, failure);
  save_point(plan, number, failure);
}

}  // namespace

PointsPlan::PointsPlan(const RunOptions& options, const ExperimentFile& file, Inspect inspect)
    : options(options),
      file(file),
      inspect(std::move(inspect)),
      results(results_folder(options)),
      keys(make_keys(file, options.until_s)),
      origin(make_origin(options, file, results)) {}

Results find_points(const PointsPlan& plan, const std::vector<std::size_t>& numbers) {
  Results results(plan.keys.size());
  const RunOptions& o = plan.options;
  if (o.profile || !o.trace.empty() || !o.timeline.empty()) return results;
  for (const auto i : numbers)
    if (!is_timed(plan.file.points[i].experiment))
      if (auto record = find_record(plan.results, plan.keys[i])) results[i] = std::move(*record);
  return results;
}

void run_points(const PointsPlan& plan, const std::vector<std::size_t>& numbers, Results& results) {
  const auto there = results.size() - missing_points(results).size();
  Progress bar("simulating", there);
  auto done = there;
  for_each_job(
      numbers.size(), plan.options.jobs,
      [&](std::size_t i) { return run_and_save(plan, numbers[i]).dump(); },
      [&](JobEnd end) {
        auto& result = results[numbers[end.index]];
        result = end.died.empty() ? ordered_json::parse(end.result) : make_failure(end.died);
        if (is_failed(result)) finish_failure(plan, numbers[end.index], result, bar);
        bar.show(++done, there + numbers.size());
      });
  if (was_interrupted() && done == 0) throw Interrupted();
}

bool is_lone(const Experiment& experiment, const ordered_json& result) {
  return is_timed(experiment) || is_failed(result) || result["ended"] == "interrupt";
}

}  // namespace laboratory
