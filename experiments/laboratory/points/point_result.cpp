#include "experiments/laboratory/points/point_result.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <new>
#include <numeric>

#include "base/errors.hpp"
#include "experiments/laboratory/file/program.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/points/farm_run.hpp"
#include "simulator/machine/faults.hpp"

namespace laboratory {

namespace {

using nlohmann::ordered_json;

constexpr std::size_t MOST_NAMED = 10;

ordered_json make_failure(const char* ended, int exit_code, const std::string& message) {
  return {{"ended", ended},
          {"row", {{"ended", ended}}},
          {"message", message},
          {"exit_code", exit_code}};
}

}  // namespace

bool is_complete(const ordered_json& result) {
  return result["ended"] == "done" || result["ended"] == "saturated";
}

bool is_failed(const ordered_json& result) { return result.contains("message"); }

std::vector<const ordered_json*> rows_of(const ordered_json& result) {
  if (!result.contains("rows")) return {&result.at("row")};
  std::vector<const ordered_json*> rows;
  for (const auto& row : result["rows"]) rows.push_back(&row);
  return rows;
}

std::vector<std::string> notes_of(const ExperimentFile& file, const Results& results) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (!results[i].contains("notes")) continue;
    const auto prefix = results.size() > 1 ? name_of(file.points[i]) + ": " : "";
    for (const auto& note : results[i]["notes"]) notes.push_back(prefix + note.get<std::string>());
  }
  return notes;
}

std::vector<std::size_t> all_points(const ExperimentFile& file) {
  std::vector<std::size_t> all(file.points.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

std::vector<std::size_t> missing_points(const Results& results) {
  std::vector<std::size_t> missing;
  for (std::size_t i = 0; i < results.size(); ++i)
    if (results[i].is_null()) missing.push_back(i);
  return missing;
}

ordered_json make_failure(const std::exception& error) {
  const std::string what = error.what();
  if (dynamic_cast<const machine::Deadlock*>(&error)) return make_failure("deadlock", 3, what);
  if (dynamic_cast<const machine::OutOfMemory*>(&error))
    return make_failure("out of memory", 3, what);
  if (dynamic_cast<const machine::Fault*>(&error)) return make_failure("failed", 3, what);
  if (dynamic_cast<const base::InvariantBroken*>(&error)) return make_failure("failed", 1, what);
  if (dynamic_cast<const std::bad_alloc*>(&error))
    return make_failure("failed", 1, "the host is out of memory");
  return {};
}

ordered_json make_failure(const std::string& died) { return make_failure("failed", 1, died); }

void add_axes(const Experiment& experiment, ordered_json& failure) {
  if (experiment.program == "farm") return failure.update(describe_farm(experiment));
  failure["row"] = ordered_json::object();
  if (!find_pattern(experiment.program)->uses_topology) return;
  const auto topology = make_workers(experiment);
  failure["topology"] = topology.name;
  failure["processors"] = topology.processors;
}

std::string describe_end(const Results& results, std::size_t points) {
  std::map<std::string, std::size_t> counts;
  for (const auto& result : results) ++counts[result["ended"].get<std::string>()];
  if (counts["done"] == points)
    return points == 1 ? "done" : fmt::format("all {} points are done", points);
  std::string text = fmt::format("{} of {} points are done", counts["done"], points);
  for (const auto& [why, meaning] :
       {std::pair("saturated", "saturated: queues grow without bound"),
        std::pair("limit", "cut short at the time limit"),
        std::pair("interrupt", "cut short by the user"), std::pair("deadlock", "deadlocked"),
        std::pair("out of memory", "out of simulated memory"), std::pair("failed", "failed")})
    if (counts[why] > 0) text += fmt::format(", {} {}", counts[why], meaning);
  if (results.size() < points) text += fmt::format(", {} not started", points - results.size());
  return text;
}

void throw_failures(const ExperimentFile& file, const Results& results, const std::string& where) {
  std::vector<std::string> names;
  int exit_code = 3;
  for (std::size_t i = 0; i < results.size(); ++i) {
    if (results[i].is_null() || !is_failed(results[i])) continue;
    if (file.axes.empty())
      throw JobFailed(results[i]["message"].get<std::string>(), results[i]["exit_code"].get<int>());
    names.push_back(name_of(file.points[i]));
    exit_code = std::min(exit_code, results[i]["exit_code"].get<int>());
  }
  if (names.empty()) return;
  const auto failed = names.size();
  if (failed > MOST_NAMED) {
    names.resize(MOST_NAMED);
    names.push_back("...");
  }
  throw JobFailed(fmt::format("{} of {} point(s) failed, at {}; {}", failed, file.points.size(),
                              fmt::join(names, "; "), where),
                  exit_code);
}

}  // namespace laboratory
