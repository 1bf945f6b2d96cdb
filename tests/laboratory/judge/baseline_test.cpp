// Tables [[baseline]]: the speed-up of each row over another row of the same sweep.
#include "base/errors.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "tests/laboratory/support/sweep.hpp"

namespace laboratory {
namespace {

struct Baseline : Sweep {
  Outcome run_with(const std::string& baselines) {
    std::ofstream(folder.path / "e.toml")
        << "[program]\nname = \"message\"\n[sweep]\nbytes = [4, 64]\nswitches = [0, 1, 2]\n"
        << baselines;
    return run({"-o", "r", "--jobs", "1"});
  }
};

TEST_F(Baseline, EachRowIsComparedWithTheOneThatIsNamed) {
  const auto done = run_with(
      "[[baseline]]\nname = \"direct\"\nat = \"switches = 0\"\nof = \"latency_s\"\n"
      "[[baseline]]\nname = \"short\"\nat = \"bytes = 4, switches = 1\"\nof = \"latency_s\"\n"
      "[[check]]\nname = \"slower\"\nof = \"speedup_direct\"\nat_most = 1\n");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  EXPECT_TRUE(contains(done.out, "speedup_direct")) << done.out;
  EXPECT_TRUE(contains(done.out, "ok       slower")) << done.out;
  const auto table = parse_csv(read_file(folder.path / "r/results.csv"), "r");
  const auto number = [&](std::size_t row, const char* column) {
    return as_number(table.rows[row][table.find(column).value()]).value();
  };
  ASSERT_EQ(table.rows.size(), 6u);
  for (std::size_t row = 0; row < 6; ++row) {
    const std::size_t direct = row / 3 * 3;
    EXPECT_DOUBLE_EQ(number(row, "speedup_direct"),
                     number(direct, "latency_s") / number(row, "latency_s"));
    EXPECT_DOUBLE_EQ(number(row, "speedup_short"),
                     number(1, "latency_s") / number(row, "latency_s"));
  }
  const auto again = tlab(folder.path, {"report", "r"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(contains(read_file(folder.path / "r/report.html"), "speedup_direct"));
}

TEST_F(Baseline, ARowThatIsNotThereLeavesCellsEmpty) {
  const auto done =
      run_with("[[baseline]]\nname = \"far\"\nat = \"switches = 7\"\nof = \"latency_s\"\n");
  ASSERT_EQ(done.exit_code, 0) << done.out << done.err;
  const auto table = parse_csv(read_file(folder.path / "r/results.csv"), "r");
  for (const auto& row : table.rows) EXPECT_EQ(row[table.find("speedup_far").value()], Value());
}

TEST_F(Baseline, WhatIsWrongIsNamed) {
  const std::pair<const char*, const char*> wrong[] = {
      {"name = \"a b\"\nat = \"switches = 0\"", "expected a name of letters, digits and _"},
      {"name = \"a\"", "\"at\" is missing, expected AXIS = VALUE"},
      {"name = \"a\"\nat = \"switches\"", "e.toml"},
      {"name = \"a\"\nat = \"swtches = 0\"\nof = \"latency_s\"",
       "\"swtches\" is not an axis of the results, the nearest is \"switches\""},
      {"name = \"a\"\nat = \"switches = 0\"\nof = \"latenc_s\"", "latency_s"},
      {"name = \"a\"\nat = \"switches = 0\"\nof = \"mine\"\n[let]\nmine = \"latency_s\"",
       "of: found mine, a name of [let], expected a column of the results"},
      {"name = \"a\"\nat = \"switches = 0} + {bytes @ switches = 1\"", "at: found switches = 0} +"},
      {"name = \"a\"\nat = \"switches = 0, switches = 1\"\nof = \"latency_s\"",
       "found switches twice"},
      {"name = \"a\"\nat = \"switches = 0\"\nwhere = \"1\"", "unknown key \"where\""}};
  for (const auto& [text, expected] : wrong) {
    const auto done = run_with(std::string("[[baseline]]\n") + text + "\n");
    EXPECT_EQ(done.exit_code, 2) << text;
    EXPECT_TRUE(contains(done.err, expected)) << done.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path / "r/results.csv"));
  }
}

}  // namespace
}  // namespace laboratory
