// tlab report: plots and report.html of results that are there.
#include <fmt/format.h>

#include <map>

#include "base/errors.hpp"
#include "experiments/laboratory/host/carry.hpp"
#include "experiments/laboratory/host/files.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/report/run_report.hpp"

namespace laboratory {

namespace {

using nlohmann::ordered_json;
namespace fs = std::filesystem;

// A point of run.json with its record.
void add_point(Simulation& s, const Point& point, const ordered_json& json, ordered_json record) {
  record.erase("use");
  for (const char* key : {"key_images", "images"})
    if (json.contains(key)) record[key] = json[key];
  s.file.points.push_back(point);
  s.records.push_back(json.at("record").get<std::string>());
  s.images.push_back(json.value("image", ""));
  s.results.push_back(std::move(record));
}

Simulation load_simulation(const fs::path& folder, const ExperimentFile& file) {
  const auto run = ordered_json::parse(read_file(folder / "run.json"));
  Simulation s;
  s.file = file;
  s.file.points.clear();
  std::map<std::string, const Point*> points;
  for (const auto& point : file.points) points[name_of(point)] = &point;
  for (const auto& json : run.at("points")) {
    auto record = load_record(folder / json.at("record").get<std::string>());
    const Point* point = points.at(record.at("at").get<std::string>());
    add_point(s, *point, json, std::move(record));
  }
  s.table = make_table(s.file, s.results);
  s.checks = eval_checks(plan_checks(s.file), s.file, s.table);
  s.ended = run.at("ended").get<std::string>();
  s.complete = run.at("complete").get<bool>();
  return s;
}

}  // namespace

void report_results(const std::string& results) {
  const Origin origin = load_origin(results, "run.json");
  ResultsFolder folder(results);
  carry_files(results, folder.working());
  carry_files(results / fs::path("points"), folder.working() / "points");
  carry_records(results, folder.working());
  carry_files(results / lone_records_folder(), folder.working() / lone_records_folder());
  try {
    write_report(folder.working(), origin.options, load_simulation(folder.working(), origin.file));
  } catch (const ordered_json::exception& error) {
    throw base::BadInput(
        fmt::format("{}: damaged: {}", (fs::path(results) / "run.json").string(), error.what()));
  }
  folder.commit();
  fmt::print("report   {}\n", (fs::path(results) / "report.html").string());
}

}  // namespace laboratory
