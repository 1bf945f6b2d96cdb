#include "experiments/laboratory/points/points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "base/errors.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_key.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/run_point.hpp"
#include "experiments/laboratory/points/trace_files.hpp"
#include "experiments/laboratory/setup/machine_model.hpp"
#include "experiments/laboratory/setup/network_setup.hpp"
#include "simulator/machine/faults.hpp"

namespace laboratory {

namespace {

using nlohmann::ordered_json;

// Axes that another key makes void would give rows that say one thing and are another.
void check_axes(const ExperimentFile& file) {
  for (std::size_t axis = 0; axis < file.axes.size(); ++axis)
    for (const auto& point : file.points) {
      const Experiment& e = point.experiment;
      const auto& key = file.axis_keys[axis];
      std::string by = e.program->voids ? e.program->voids(e.params, key) : "";
      if (key == "network.workers" && has_own_workers(e)) by = "network.topology";
      if (!by.empty())
        throw base::BadInput(fmt::format("{}: [sweep] has an axis {}, but {} says how many itself",
                                         file.path, file.axes[axis], by));
    }
}

// Whatever room finds something wrong, it is wrong in the file.
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

PointResult run_traced(const PointsPlan& plan, std::size_t number) {
  const Point& point = plan.file.points[number];
  const auto& title = point.experiment.title;
  TraceFiles files(plan.options);
  const auto save = [&] {
    files.save(point.at.empty() ? title : fmt::format("{}: {}", title, name_of(point)));
  };
  try {
    auto result = run_point(point.experiment, plan.results / records_folder(), plan.options.profile,
                            files.watch());
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

void save_point(const PointsPlan& plan, std::size_t number, const PointResult& result) {
  const Point& point = plan.file.points[number];
  const bool lone = is_lone(point.experiment, result);
  if (lone && plan.lone.empty()) return;
  if (!lone) save_origin(plan.results, plan.origin);
  save_record(lone ? plan.lone : plan.results / records_folder(), plan.keys[number], result,
              name_of(point));
}

// In the child: a failure is a result too, bad input is not.
PointResult run_and_save(const PointsPlan& plan, std::size_t number) {
  const Point& point = plan.file.points[number];
  try {
    auto result = run_traced(plan, number);
    save_point(plan, number, result);  // first: a name mistyped in the file costs no result
    if (plan.inspect) plan.inspect(point, result);
    result.use = nullptr;
    return result;
  } catch (const std::exception& error) {
    if (const auto failure = make_failure(error)) return *failure;
    if (plan.file.axes.empty()) throw;
    throw JobFailed(fmt::format("at {}: {}", name_of(point), error.what()), exit_code_of(error));
  }
}

// Adds what the axes of a failed point need, and records it.
void finish_failure(const PointsPlan& plan, std::size_t number, PointResult& failure,
                    Progress& bar) {
  const Point& point = plan.file.points[number];
  if (!plan.file.axes.empty())
    bar.say(fmt::format("tlab: at {}: {}", name_of(point), failure.message));
  const auto known = describe_point(point.experiment);
  failure.topology = known.topology;
  failure.processors = known.processors;
  failure.described = known.described;
  save_point(plan, number, failure);
}

}  // namespace

void check_points(const RunOptions& options, const ExperimentFile& file, std::size_t chosen) {
  check_trace_files(options, chosen, results_folder(options));
  check_axes(file);
  std::set<std::string> networks;
  for (const auto& point : file.points)
    check_in(file, [&] {
      const Experiment& e = point.experiment;
      check_point(e);
      if (networks.insert(network_key(e)).second) check_network(e);
    });
}

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
        if (result.is_failed()) finish_failure(plan, numbers[end.index], result, bar);
        bar.show(++done, there + numbers.size());
      });
  if (was_interrupted() && done == 0) throw Interrupted();
}

bool is_lone(const Experiment& experiment, const PointResult& result) {
  return experiment.is_timed || result.is_failed() || result.ended == "interrupt";
}

}  // namespace laboratory
