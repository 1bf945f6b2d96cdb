#include "experiments/laboratory/points/single_worker.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/errors.hpp"
#include "experiments/laboratory/host/error_text.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/points/run_point.hpp"
#include "experiments/laboratory/setup/setup.hpp"

namespace laboratory {
namespace {

const base::Cell* find_cell(const PointResult& result, const std::string& column) {
  if (result.rows.size() != 1) return nullptr;
  const auto cell = std::ranges::find(result.rows[0], column, &base::Row::value_type::first);
  return cell == result.rows[0].end() ? nullptr : &cell->second;
}

std::optional<double> time_of(const PointResult& result) {
  const auto* time = find_cell(result, "time_s");
  const auto* seconds = time ? std::get_if<double>(time) : nullptr;
  return seconds && result.is_complete() ? std::optional(*seconds) : std::nullopt;
}

bool needs_single(const Point& point, const PointResult& result) {
  const auto* speedup = find_cell(result, "speedup");
  return point.experiment.program->uses.network && has_own_workers(point.experiment) &&
         result.processors > 1 && time_of(result) && speedup && *speedup == base::Cell();
}

// True for keys that have no meaning on a network of one worker.
bool is_of_network(const std::string& key) {
  return key == "fault" || key == "processor" ||
         (key.starts_with("network.") && key != "network.switches");
}

// Copies the file without its points, and without axes and keys that concern the network.
ExperimentFile without_network(const ExperimentFile& file) {
  ExperimentFile single = file;
  single.points.clear();
  for (auto& coupled : single.sweep)
    std::erase_if(coupled, [](const Axis& axis) { return is_of_network(axis.key); });
  std::erase_if(single.sweep, [](const Coupled& coupled) { return coupled.empty(); });
  std::erase_if(single.keys, [](const auto& setting) { return is_of_network(setting.first); });
  single.keys["network.topology"] = make_node("line");
  single.keys["network.workers"] = make_node(std::int64_t{1});
  return single;
}

Point make_single(const Point& point) {
  Point single = point;
  std::erase_if(single.at, [](const Coordinate& at) { return is_of_network(at.key); });
  Experiment& e = single.experiment;
  e.topology = {"line", "line"};
  e.workers = 1;
  e.switches_between.clear();
  e.routes = {};
  e.tree.clear();
  e.tree_links.clear();
  e.faults.clear();
  e.others.clear();
  return single;
}

void run_missing(const PointsPlan& plan, Results& results) {
  try {
    for (const auto& point : plan.file.points) check_point(point.experiment);
    run_points(plan, missing_points(results), results);
  } catch (const std::runtime_error& error) {
    complain(fmt::format("no speed-up: a single worker of the machine: {}", describe_error(error)));
  }
}

}  // namespace

void measure_single_workers(const PointsPlan& plan, Results& results, SingleWorker single_worker) {
  ExperimentFile file = without_network(plan.file);
  // simulated time of each single worker in seconds, by the name of its point
  std::map<std::string, double> times;
  // the points that need the time of a single worker, by the name of the single worker's point
  std::map<std::string, std::vector<std::size_t>> needed;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const Point& point = plan.file.points[i];
    const Point single = make_single(point);
    if (const auto time = time_of(results[i]); time && results[i].processors == 1)
      times.emplace(name_of(single), *time);
    if (!needs_single(point, results[i])) continue;
    auto& points = needed[name_of(single)];
    if (points.empty()) file.points.push_back(single);
    points.push_back(i);
  }
  std::erase_if(file.points, [&](const Point& point) { return times.contains(name_of(point)); });
  if (!file.points.empty()) {
    RunOptions options = plan.options;
    options.trace = options.timeline = "";
    options.films = {};
    options.profile = false;
    PointsPlan more(options, file);
    more.lone = plan.lone;
    more.origin = plan.origin;
    Results found = find_points(more, all_points(file));
    if (single_worker == SingleWorker::run && !missing_points(found).empty() && !was_interrupted())
      run_missing(more, found);
    for (std::size_t i = 0; i < found.size(); ++i)
      if (const auto time = time_of(found[i])) times.emplace(name_of(file.points[i]), *time);
  }
  for (const auto& [name, points] : needed)
    if (const auto time = times.find(name); time != times.end())
      for (const auto i : points) results[i].single_s = time->second;
}

}  // namespace laboratory
