// Expressions that use columns of their own row and of other rows of the sweep.
#include "experiments/laboratory/judge/rows.hpp"

#include "base/errors.hpp"
#include "tests/laboratory/support/load.hpp"

namespace laboratory {
namespace {

// Twelve points. The axes are topology, workers together with height, and objects.
struct RowsCase {
  ExperimentFile file = load(
      "[sweep]\ntopology = [\"tree\", \"mesh\"]\n\"workers, height\" = [[1, 16], [2, 16], [4, "
      "32]]\n"
      "objects = [200, 800]\n");
  Table table{.columns = {"topology", "workers", "objects", "height", "time_s", "link", "ended"},
              .axes = 4,
              .rows = {}};

  RowsCase() {
    for (const auto& point : file.points) {
      const auto& e = point.experiment;
      const auto height = std::get<std::int64_t>(get_value(e, "image.height"));
      table.rows.push_back({e.topology.text, e.workers, objects_of(e), height,
                            double(objects_of(e)) / double(e.workers), "a>b", "done"});
    }
  }
  std::optional<double> eval(const std::string& text, std::size_t row) const {
    return Rows(file, table).eval(Expression(text, "e.toml:1: x"), row);
  }
  std::string message(const std::string& text) const {
    return message_of<base::BadInput>(
        [&] { Rows(file, table).check(Expression(text, "e.toml:1: x"), 0); });
  }
};

TEST(ExperimentsRows, BracesNameARowWithTheSameOtherAxes) {
  const RowsCase test;
  for (std::size_t row = 0; row < test.table.rows.size(); ++row) {
    const double workers = *as_number(test.table.rows[row][1]);
    // Height changes together with workers. The row with workers = 1 may therefore have another
    // height.
    EXPECT_EQ(test.eval("{time_s @ workers = 1} / time_s", row), workers) << row;
    EXPECT_EQ(test.eval("{ time_s@height=32,objects = 200 } + workers", row), 50 + workers) << row;
    EXPECT_EQ(test.eval("{time_s @ topology = mesh} - time_s", row), 0) << row;
    const auto before = test.eval("{time_s @ workers = workers / 2} / time_s", row);
    EXPECT_EQ(before, workers > 1 ? std::optional(2.0) : std::nullopt) << row;
  }
}

TEST(ExperimentsRows, ARowThatIsNotThereOrDidNotEndLeavesOut) {
  RowsCase test;
  EXPECT_FALSE(test.eval("{time_s @ objects = 400}", 0));
  EXPECT_FALSE(test.eval("{time_s @ workers = 2, height = 32}", 0)) << "both are asked for";
  EXPECT_TRUE(test.eval("{time_s @ objects = 800}", 0));
  test.table.rows[1].back() = "limit";
  EXPECT_FALSE(test.eval("{time_s @ objects = 800}", 0));
}

TEST(ExperimentsRows, OfCoupledAxesTheOwnValuesComeFirst) {
  const RowsCase test;
  EXPECT_EQ(test.eval("{workers @ height = 16}", 0), 1);
  EXPECT_EQ(test.eval("{workers @ height = 16}", 2), 2) << "its own workers";
  const auto message = message_of<base::BadInput>([&] { test.eval("{workers @ height = 16}", 4); });
  EXPECT_NE(message.find(
                "e.toml:1: x: {workers @ height = 16}: found rows with several values of workers"),
            std::string::npos)
      << message;
  EXPECT_TRUE(message.ends_with("write {workers @ height = 16, workers = workers}")) << message;
  EXPECT_FALSE(test.eval("{workers @ height = 16, workers = workers}", 4));
}

TEST(ExperimentsRows, NoOtherRowStandsInForOneThatDidNotEnd) {
  RowsCase test;
  test.table.rows[0].back() = "limit";
  EXPECT_FALSE(test.eval("{workers @ height = 16}", 0));
  EXPECT_EQ(test.eval("{workers @ height = 16}", 2), 2);
}

TEST(ExperimentsRows, DefinitionsMayUseAndBeUsedInBraces) {
  const RowsCase test;
  Rows rows(test.file, test.table);
  rows.define("speedup", Expression("{time_s @ workers = 1} / time_s", "a"), "a");
  rows.define("gain", Expression("speedup / {speedup @ workers = workers / 2} - 1", "b"), "b");
  EXPECT_EQ(rows.eval(Expression("{speedup @ workers = 4}", "c"), 0), 4);
  EXPECT_EQ(rows.eval(Expression("gain", "c"), 4), 1);
  EXPECT_FALSE(rows.eval(Expression("1 + gain", "c"), 0)) << "one worker has no half";
}

TEST(ExperimentsRows, MistakesInBracesAreNamed) {
  const RowsCase test;
  for (const auto& [text, message] : std::vector<std::pair<std::string, std::string>>{
           {"{time_s}", "e.toml:1: x: found {time_s}, expected {COLUMN @ AXIS = VALUE, ...}"},
           {"{time_s @ workers}", "found \"workers\", expected AXIS = VALUE"},
           {"{time_s @ workers = 1", "expected a } for each {"},
           {"{time @ workers = 1}", "unknown variable \"time\", the nearest is \"time_s\""},
           {"{time_s @ worker = 1}",
            "x: {time_s @ worker = 1}: \"worker\" is not an axis of the results, the nearest is "
            "\"workers\""},
           {"{time_s @ time_s = 1}", "\"time_s\" is not an axis"},
           {"{time_s @ workers = many}", "unknown variable \"many\""},
           {"{time_s @ workers = 2x2}", "found \"2x2\", expected a number for the axis workers"},
           {"{link @ workers = 1}", "found link, which is a text"}})
    EXPECT_NE(test.message(text).find(message), std::string::npos) << test.message(text);
}

}  // namespace
}  // namespace laboratory
