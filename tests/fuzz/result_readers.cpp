#include <filesystem>

#include "base/whole_file.hpp"
#include "experiments/laboratory/judge/check_results.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/report/exhibit.hpp"
#include "experiments/laboratory/report/simulation.hpp"
#include "tests/fuzz/kinds.hpp"

namespace fuzz {
namespace {

namespace fs = std::filesystem;

using laboratory::ExperimentFile;
using laboratory::PointResult;
using nlohmann::ordered_json;

const std::string THESIS = "experiments/thesis";

void expect_same_points(const ExperimentFile& found, const ExperimentFile& expected) {
  expect_same("the experiment", resolve(found), resolve(expected));
  expect_same("settings", laboratory::spell_keys(found.keys),
              laboratory::spell_keys(expected.keys));
  expect_same("the number of points", found.points.size(), expected.points.size());
  for (std::size_t i = 0; i < found.points.size(); ++i)
    expect_same("a point", name_of(found.points[i]), name_of(expected.points[i]));
}

void read_experiment(const std::string& text, const laboratory::Overrides& overrides) {
  const auto path = place_of(THESIS + "/fuzz.toml"), folder = place_of(THESIS);
  const auto file = laboratory::load_experiment({text, path, folder}, overrides);
  expect(!file.points.empty(), "an experiment has points");
  expect_same_points(
      read_again("the experiment",
                 [&] {
                   return laboratory::load_experiment({resolve(file), path, folder}, {});
                 }),
      file);
}

// Reads each line as the argument of an option --set.
void read_overrides(const std::string& text) {
  laboratory::Overrides overrides;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    overrides.push_back(laboratory::parse_override(line));
  read_experiment("[image]\nwidth = 8\n[sweep]\nworkers = [1, 2]\n", overrides);
}

// Reads a record, first as it is, and then with the right hash at its end.
void read_record(const std::string& text) {
  base::save_whole("0.json", text);
  try {
    laboratory::load_record("0.json");
    throw Broken("a record without its seal is taken for whole");
  } catch (const base::BadInput&) {
  }
  laboratory::PointResult result;
  try {
    result = laboratory::to_result(ordered_json::parse(text));
  } catch (const ordered_json::exception& error) {
    throw base::BadInput(error.what());
  }
  laboratory::save_record(".", "1", result, "fuzz");
  const auto again = read_again("a record", [] { return laboratory::load_record("1.json"); });
  expect_same("a record", to_json(again).dump(), to_json(result).dump());
}

void read_run(const std::string& text) {
  base::save_whole("run.json", text);
  const auto origin = laboratory::load_origin(".", "run.json");
  check_same_experiment(".", origin.file);
  const auto written = make_origin(origin.options, origin.file, ".");
  base::save_whole("run.json", written.dump());
  const auto again =
      read_again("run.json", [] { return laboratory::load_origin(".", "run.json"); });
  expect_same_points(again.file, origin.file);
  expect_same("the command", command_line(again.options), command_line(origin.options));
}

PointResult load_result(const std::string& name) {
  const auto text = base::read_text(place_of("tests/fuzz/corpus/record/" + name));
  return laboratory::to_result(ordered_json::parse(text));
}

// The results of two points, "workers = 1" and "workers = 2".
const laboratory::Results& two_results() {
  static const laboratory::Results results{load_result("0.json"), load_result("1.json")};
  return results;
}

// Reads a text as the file run.json of a results folder that has the records 0.json and 1.json.
void read_simulation(const std::string& text) {
  const fs::path folder = "results";
  save_two_records(folder / "points/fuzz");
  base::save_whole(folder / "run.json", text);
  const auto origin = laboratory::load_origin(folder, "run.json");
  try {
    const auto simulation = laboratory::load_simulation(folder, origin.file);
    expect_same("the number of points", simulation.file.points.size(), simulation.results.size());
    make_checks_csv(simulation.checks, simulation.table);
  } catch (const ordered_json::exception& error) {
    throw laboratory::make_damaged("run.json", error);
  }
}

constexpr std::string_view WITH_REFERENCE =
    "[[check]]\nname = \"c\"\nof = \"time_s\"\nreference = \"reference.csv\"\n"
    "keys = [\"workers\"]\nwithin = 0.1\n"
    "[[plot]]\nname = \"p\"\nx = \"workers\"\ny = \"time_s\"\nreference = \"reference.csv\"\n"
    "keys = [\"workers\"]\n[sweep]\nworkers = [1, 2]\n";

void read_reference(const std::string& text) {
  static const auto file =
      laboratory::load_experiment({std::string(WITH_REFERENCE), "reference.toml", ""}, {});
  static const auto table = make_table(file, two_results());
  base::save_whole("reference.csv", text);
  const auto plan = laboratory::plan_checks(file);
  const auto checks = eval_checks(plan, file, table);
  for (const auto& check : checks) summarize(check, table), make_check_table(check, table, 5);
  make_checks_csv(checks, table);
  std::vector<std::string> notes;
  make_exhibits(plan, make_rows(plan, file, table), {}, notes);
}

}  // namespace

void save_two_records(const fs::path& folder) {
  for (const auto i : {0, 1})
    if (const auto key = fmt::format("{}", i); !fs::exists(folder / (key + ".json")))
      laboratory::save_record(folder, key, two_results()[static_cast<std::size_t>(i)],
                              fmt::format("workers = {}", i + 1));
}

std::vector<Reader> result_readers() {
  return {
      {"experiment",
       ".toml",
       {THESIS, "experiments/formulas", "experiments/studies"},
       [](const auto& text) { read_experiment(text, {}); }},
      {"override", ".txt", {}, read_overrides},
      {"record", ".json", {}, read_record},
      {"run", ".json", {}, read_run},
      {"simulation", ".json", {}, read_simulation},
      {"reference", ".csv", {}, read_reference},
  };
}

}  // namespace fuzz
