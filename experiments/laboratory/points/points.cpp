#include "experiments/laboratory/points/points.hpp"

#include <fmt/format.h>

#include <new>
#include <set>

#include "base/errors.hpp"
#include "experiments/laboratory/host/error_text.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/run_point.hpp"
#include "experiments/laboratory/setup/setup.hpp"

namespace laboratory {
namespace {

using nlohmann::ordered_json;

// Throws for an axis without effect, since the results table would show values that were not used.
void check_axes(const ExperimentFile& file) {
  for (const auto& [axis, key, values] : file.axes())
    for (const auto& point : file.points) {
      const Experiment& e = point.experiment;
      std::string by = e.program->voids ? e.program->voids(e.params, key) : "";
      if (key == "network.workers" && has_own_workers(e)) by = "network.topology";
      base::require(by.empty(), file.path,
                    "found the axis {} in [sweep], but {} already determines the number", axis, by);
    }
}

void save_point(const PointsPlan& plan, std::size_t number, const PointResult& result) {
  const Point& point = plan.file.points[number];
  const bool lone = is_lone(point.experiment, result);
  if (lone && plan.lone.empty()) return;
  if (!lone) save_origin(plan.results, plan.file, plan.origin);
  save_record(lone ? plan.lone : plan.results / records_folder(), plan.keys[number], result,
              name_of(point));
}

// Adds the names of drawings to the message of a failure. Only reports an error in drawing, so that
// the failure itself is not lost.
void add_drawings(const PointsPlan& plan, const Point& point, PointResult& failure) {
  if (!plan.explain || !failure.is_failed()) return;
  try {
    failure.message += plan.explain(point, plan.options, failure);
  } catch (const std::exception& error) {
    complain(fmt::format("no drawing of the fault: {}", describe_error(error)));
  }
}

// Runs a point in the child process. A failed simulation is a result too; bad input is an
// exception.
PointResult run_and_save(const PointsPlan& plan, std::size_t number) {
  const Point& point = plan.file.points[number];
  Clock clock;
  try {
    auto result = plan.run(point, plan.options, plan.results / records_folder());
    add_drawings(plan, point, result);
    // saves the result before the inspection, whose errors would lose it
    save_point(plan, number, result);
    if (plan.inspect) plan.inspect(point, result);
    result.use = nullptr;
    return result;
  } catch (const std::exception& error) {
    if (auto failure = make_failure(error)) {
      failure->host.total_s = clock.lap();
      add_drawings(plan, point, *failure);
      return *failure;
    }
    if (plan.file.sweep.empty()) throw;
    throw Failure(fmt::format("at {}: {}", name_of(point), describe_error(error)),
                  exit_code_of(error));
  }
}

// Reports and records a failed point. Adds the name of the topology, its size, and the columns
// known before the simulation, because these identify the point's row in the table.
void finish_failure(const PointsPlan& plan, std::size_t number, PointResult& failure,
                    Progress& bar) {
  const Point& point = plan.file.points[number];
  if (!plan.file.sweep.empty())
    bar.say(fmt::format("tlab: at {}: {}", name_of(point), failure.message));
  const auto known = describe_point(point.experiment);
  failure.topology = known.topology;
  failure.processors = known.processors;
  failure.described = known.described;
  save_point(plan, number, failure);
}

}  // namespace

void check_points(const RunOptions& options, const ExperimentFile& file) {
  check_axes(file);
  std::set<std::string> networks;
  for (const auto& point : file.points) try {
      check_point(point.experiment);
      check_threads(options, point.experiment);
      if (networks.insert(network_key(point.experiment)).second) check_network(point.experiment);
      // every error found here is an error of the experiment file, whatever module throws it
    } catch (const std::runtime_error& error) {
      throw base::BadInput(base::add_place(file.path, error.what()));
    } catch (const std::bad_alloc&) {
      throw base::BadInput(fmt::format("{}: {}: the host is out of memory", file.path,
                                       point.at.empty() ? "its point" : name_of(point)));
    }
}

PointsPlan::PointsPlan(const RunOptions& options, const ExperimentFile& file, Inspect inspect,
                       RunPoint run_one, Explain explain)
    : options(options),
      file(file),
      inspect(std::move(inspect)),
      run(std::move(run_one)),
      explain(std::move(explain)),
      results(results_folder(options)),
      keys(make_keys(file, options.until_s)),
      origin(make_origin(options, file, results)) {
  if (!run)
    run = [](const Point& point, const RunOptions& with, const std::filesystem::path& images) {
      return run_point(point, with, images);
    };
}

Results find_points(const PointsPlan& plan, const std::vector<std::size_t>& numbers) {
  Results results(plan.keys.size());
  if (plan.options.runs_anew()) return results;
  for (const auto i : numbers)
    if (!plan.file.points[i].experiment.is_timed)
      if (auto record = find_record(plan.results, plan.keys[i])) results[i] = std::move(*record);
  return results;
}

void run_points(const PointsPlan& plan, const std::vector<std::size_t>& numbers, Results& results) {
  const auto there = results.size() - missing_points(results).size();
  Progress bar("simulating", there);
  auto done = there;
  for_each_job(
      numbers.size(), plan.options.jobs,
      [&](std::size_t i) { return to_json(run_and_save(plan, numbers[i])).dump(); },
      [&](JobEnd end) {
        auto& result = results[numbers[end.index]];
        result =
            end.died.empty() ? to_result(ordered_json::parse(end.result)) : make_failure(end.died);
        if (result.ended == "interrupt" && !was_interrupted())
          result = make_failure(fmt::format(
              "its process was asked to end, and tlab was not{}",
              plan.options.runs_anew() ? "; trace, chart and films of the run so far are kept"
                                       : ""));
        if (result.is_failed()) finish_failure(plan, numbers[end.index], result, bar);
        bar.show(++done, there + numbers.size());
      });
  if (was_interrupted() && done == 0) throw Interrupted();
}

bool is_lone(const Experiment& experiment, const PointResult& result) {
  return experiment.is_timed || result.is_failed() || result.ended == "interrupt";
}

}  // namespace laboratory
