#include "base/whole_file.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "tests/fuzz/kinds.hpp"

namespace fuzz {
namespace {

using laboratory::ExperimentFile;
using nlohmann::ordered_json;

const std::string THESIS = "experiments/thesis";

void expect_same_points(const ExperimentFile& found, const ExperimentFile& expected) {
  expect_same("the experiment", found.resolved, expected.resolved);
  expect_same("axes", found.axis_keys, expected.axis_keys);
  expect_same("settings", found.settings, expected.settings);
  expect_same("the number of points", found.points.size(), expected.points.size());
  for (std::size_t i = 0; i < found.points.size(); ++i)
    expect_same("a point", name_of(found.points[i]), name_of(expected.points[i]));
}

void read_experiment(const std::string& text) {
  const auto path = place_of(THESIS + "/fuzz.toml"), folder = place_of(THESIS);
  const auto file = laboratory::read_experiment(text, path, folder, {});
  expect(!file.points.empty(), "an experiment has points");
  expect_same_points(
      read_again("the experiment",
                 [&] { return laboratory::read_experiment(file.resolved, path, folder, {}); }),
      file);
}

// A record without its seal, and then with it.
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
  const auto written = make_origin(origin.options, origin.file, ".");
  base::save_whole("run.json", written.dump());
  const auto again =
      read_again("run.json", [] { return laboratory::load_origin(".", "run.json"); });
  expect_same_points(again.file, origin.file);
  expect_same("the command", command_line(again.options), command_line(origin.options));
}

}  // namespace

std::vector<Reader> result_readers() {
  return {
      {"experiment",
       ".toml",
       {THESIS, "experiments/formulas", "experiments/studies"},
       read_experiment},
      {"record", ".json", {}, read_record},
      {"run", ".json", {}, read_run},
  };
}

}  // namespace fuzz
