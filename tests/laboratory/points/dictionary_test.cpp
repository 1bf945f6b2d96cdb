// The contents of results.schema.json, and how numbers are written in run.json.
#include <nlohmann/json.hpp>

#include "experiments/laboratory/table/table.hpp"
#include "tests/laboratory/support/sweep.hpp"

namespace laboratory {
namespace {

using nlohmann::ordered_json;

TEST_F(Sweep, TheDictionaryHasEveryColumnWithTypeUnitAndMeaning) {
  ASSERT_EQ(run({"-o", "r", "--jobs", "1"}).exit_code, 0);
  const auto schema = ordered_json::parse(read_file(folder.path / "r/results.schema.json"));
  const auto table = parse_csv(read_file(folder.path / "r/results.csv"), "r");
  ASSERT_EQ(schema["fields"].size(), table.columns.size());
  EXPECT_EQ(schema["primaryKey"], (ordered_json{"topology", "workers", "objects"}));
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const auto& field = schema["fields"][c];
    SCOPED_TRACE(field.dump());
    EXPECT_EQ(field["name"], table.columns[c]);
    EXPECT_TRUE(field.contains("description"));
    for (const auto& row : table.rows) {
      if (row[c] == Value()) continue;
      EXPECT_EQ(field["type"] == "string", std::holds_alternative<std::string>(row[c]));
      if (field["type"] == "integer") {
        EXPECT_TRUE(std::holds_alternative<std::int64_t>(row[c]));
      }
    }
  }
  const auto field = [&](const std::string& name) {
    return schema["fields"][table.find(name).value()];
  };
  EXPECT_EQ(field("time_s")["unit"], "s");
  EXPECT_EQ(field("time_s")["type"], "number");
  EXPECT_EQ(field("time_s")["programs"], ordered_json{"farm"});
  EXPECT_EQ(field("stage1_s")["unit"], "s");
  EXPECT_FALSE(field("rays").contains("unit"));
  EXPECT_EQ(field("rays")["type"], "integer");
}

TEST_F(Sweep, NumbersAreNumbersInTheRecordOfARun) {
  ASSERT_EQ(run({"-o", "r", "--jobs", "1"}).exit_code, 0);
  const auto run = ordered_json::parse(read_file(folder.path / "r/run.json"));
  EXPECT_EQ(run["points"][1]["at"],
            (ordered_json{{"topology", "tree"}, {"workers", 3}, {"objects", 20}}));
}

}  // namespace
}  // namespace laboratory
