#include "experiments/laboratory/points/point_result.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <new>
#include <numeric>

#include "base/errors.hpp"
#include "experiments/laboratory/host/error_text.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "simulator/machine/faults.hpp"

namespace laboratory {
namespace {

using nlohmann::ordered_json;

constexpr std::size_t MOST_NAMED = 10;

base::Cell to_cell(const ordered_json& json) {
  if (json.is_null()) return {};
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number()) return json.get<double>();
  return json.get<std::string>();
}

ordered_json to_json(const base::Row& row) {
  auto json = ordered_json::object();
  for (const auto& [name, cell] : row) json[name] = laboratory::to_json(cell);
  return json;
}

base::Row to_row(const ordered_json& json) {
  base::Row row;
  for (const auto& [name, value] : json.items()) row.emplace_back(name, to_cell(value));
  return row;
}

ordered_json to_json(const std::vector<base::Row>& rows) {
  auto json = ordered_json::array();
  for (const auto& row : rows) json.push_back(to_json(row));
  return json;
}

std::vector<base::Row> to_rows(const ordered_json& json) {
  std::vector<base::Row> rows;
  for (const auto& row : json) rows.push_back(to_row(row));
  return rows;
}

ordered_json to_json(const std::optional<double>& number) {
  return number ? ordered_json(*number) : ordered_json();
}

std::optional<double> to_number(const ordered_json& json) {
  return json.is_number() ? std::optional(json.get<double>()) : std::nullopt;
}

PointResult make_ended(const char* ended, int exit_code, const std::string& message) {
  PointResult failure;
  failure.ended = ended;
  failure.exit_code = exit_code;
  failure.message = message;
  return failure;
}

}  // namespace

ordered_json to_json(const base::Cell& cell) {
  return std::visit(
      [](const auto& value) -> ordered_json {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, std::monostate>)
          return nullptr;
        else
          return value;
      },
      cell);
}

ordered_json to_json(const PointResult& r) {
  auto images = ordered_json::array();
  for (const auto& image : r.images)
    images.push_back({{"name", image.name},
                      {"at_s", to_json(image.at_s)},
                      {"file", image.file},
                      {"exr", image.exr},
                      {"is_named", image.is_named}});
  ordered_json json = {{"ended", r.ended},
                       {"topology", r.topology},
                       {"processors", r.processors},
                       {"described", to_json(r.described)},
                       {"rows", to_json(r.rows)},
                       {"growth", to_json(r.growth)},
                       {"notes", r.notes},
                       {"images", images},
                       {"host",
                        {{"total_s", r.host.total_s},
                         {"run_s", r.host.run_s},
                         {"kernel_s", to_json(r.host.kernel_s)},
                         {"events", r.host.events}}}};
  if (r.is_failed()) json.update({{"message", r.message}, {"exit_code", r.exit_code}});
  if (!r.histogram.empty()) json["histogram"] = to_json(r.histogram);
  if (!r.use.is_null()) json["use"] = r.use;
  if (!r.kernels.is_null()) json["kernels"] = r.kernels;
  return json;
}

PointResult to_result(const ordered_json& json) {
  PointResult r;
  r.ended = json.at("ended").get<std::string>();
  r.at = json.value("at", "");
  r.message = json.value("message", "");
  r.exit_code = json.value("exit_code", 0);
  r.topology = json.at("topology").get<std::string>();
  r.processors = json.at("processors").get<int>();
  r.described = to_row(json.at("described"));
  r.rows = to_rows(json.at("rows"));
  r.growth = to_rows(json.value("growth", ordered_json::array()));
  r.histogram = to_rows(json.value("histogram", ordered_json::array()));
  r.notes = json.at("notes").get<std::vector<std::string>>();
  for (const auto& image : json.at("images"))
    r.images.push_back({image.at("name").get<std::string>(), to_number(image.at("at_s")),
                        image.at("file").get<std::string>(), image.at("exr").get<std::string>(),
                        image.at("is_named").get<bool>()});
  const auto& host = json.at("host");
  r.host = {host.at("total_s").get<double>(), host.at("run_s").get<double>(),
            to_number(host.at("kernel_s")), host.at("events").get<std::uint64_t>()};
  if (json.contains("use")) r.use = json["use"];
  if (json.contains("kernels")) r.kernels = json["kernels"];
  return r;
}

std::vector<std::string> notes_of(const ExperimentFile& file, const Results& results) {
  std::vector<std::string> notes;
  for (std::size_t i = 0; i < results.size(); ++i) {
    const auto prefix = results.size() > 1 ? name_of(file.points[i]) + ": " : "";
    for (const auto& note : results[i].notes) notes.push_back(prefix + note);
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
    if (!results[i].is_there()) missing.push_back(i);
  return missing;
}

std::optional<PointResult> make_failure(const std::exception& error) {
  const std::string what = error.what();
  if (const auto* fault = dynamic_cast<const machine::Fault*>(&error)) {
    const char* ended = dynamic_cast<const machine::Deadlock*>(fault)      ? "deadlock"
                        : dynamic_cast<const machine::OutOfMemory*>(fault) ? "out of memory"
                                                                           : "failed";
    auto failure = make_ended(ended, 3, what);
    failure.fault_s = fault->when.value;
    return failure;
  }
  if (dynamic_cast<const base::InvariantBroken*>(&error)) return make_ended("failed", 1, what);
  if (dynamic_cast<const std::bad_alloc*>(&error)) return make_ended("failed", 2, NO_MEMORY);
  return {};
}

PointResult make_failure(const std::string& died) { return make_ended("failed", 1, died); }

std::string describe_end(const Results& results, std::size_t points) {
  std::map<std::string, std::size_t> counts;
  for (const auto& result : results) ++counts[result.ended];
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
    if (!results[i].is_failed()) continue;
    if (file.sweep.empty()) throw Failure(results[i].message, results[i].exit_code);
    names.push_back(name_of(file.points[i]));
    exit_code = std::min(exit_code, results[i].exit_code);
  }
  if (names.empty()) return;
  const auto failed = names.size();
  if (failed > MOST_NAMED) {
    names.resize(MOST_NAMED);
    names.push_back("...");
  }
  throw Failure(fmt::format("{} of {} point(s) failed, at {}; {}", failed, file.points.size(),
                            fmt::join(names, "; "), where),
                exit_code);
}

}  // namespace laboratory
