// `tlab compare`: its findings about results, and its refusals.
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "experiments/laboratory/table/table.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

const std::string FARM =
    "[network]\n[scene]\nobjects = 20\n[image]\nwidth = 16\nheight = 12\n[sweep]\nworkers = [1, "
    "3]\n";

struct Compare : testing::Test {
  Compare() { write_file(folder.path / "e.toml", FARM); }
  Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"run", "e.toml"});
    return tlab(folder.path, std::move(arguments));
  }
  Outcome compare(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "compare");
    return tlab(folder.path, std::move(arguments));
  }
  TemporaryFolder folder;
};

TEST_F(Compare, NamesSettingsModelsAndRatios) {
  ASSERT_EQ(run({"-o", "x/slow"}).exit_code, 0);
  ASSERT_EQ(run({"-o", "y/fast", "--set", "machine.model=t805-30", "--set", "image.ambient=0.2"})
                .exit_code,
            0);
  const auto outcome = compare({"x/slow", "y/fast/", "-o", "c.html", "--width", "column"});
  EXPECT_TRUE(contains(outcome.out, "figures  c-figures\n"));
  for (const char* name : {"ratio", "time_s"}) {
    const auto file = folder.path / "c-figures" / name;
    EXPECT_TRUE(contains(read_file(file.string() + ".svg"), "<svg width=\"85mm\"")) << name;
    EXPECT_TRUE(read_file(file.string() + ".pdf").starts_with("%PDF")) << name;
  }
  EXPECT_TRUE(contains(compare({"x/slow", "y/fast/", "--width", "column"}).err,
                       "--width: found no page, expected --output"));
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  for (const auto* text :
       {"slow: tlab run e.toml\n", "machine.model  t805-25  t805-30", "image.ambient", "cpu.clock",
        "25000000  30000000", "time_s: fast is 0.8", "the same in all runs: rays",
        "time_s at each point:"})
    EXPECT_TRUE(contains(outcome.out, text)) << text << "\n" << outcome.out;
  EXPECT_FALSE(contains(outcome.out, "image.width"));
  const auto page = read_file(folder.path / "c.html");
  for (const auto* text : {"<title>slow and fast</title>", "cpu.clock", "fast / slow", "<svg",
                           "time, relative to slow over workers"})
    EXPECT_TRUE(contains(page, text)) << text;
  ASSERT_EQ(compare({"x/slow", "y/fast/", "-o", "d.html"}).exit_code, 0);
  EXPECT_EQ(page, read_file(folder.path / "d.html"));
}

TEST_F(Compare, SeedsAreSamples) {
  for (const auto* topology : {"tree", "line"})
    ASSERT_EQ(run({"-o", topology, "--set", fmt::format("network.topology={}", topology), "--set",
                   "sweep.seed=[1,2,3]"})
                  .exit_code,
              0);
  const auto outcome = compare({"tree", "line", "--columns", "time_s,rays", "-o", "c.csv"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "line / tree, 95 %")) << outcome.out;
  const auto table = parse_csv(read_file(folder.path / "c.csv"), "c.csv");
  EXPECT_EQ(table.columns, (std::vector<std::string>{"result", "workers", "run", "value", "first",
                                                     "ratio", "low", "high"}));
  ASSERT_EQ(table.rows.size(), 4u);  // two results at two points
  // With one worker, times are the same for all seeds and networks, so the interval has no width.
  for (std::size_t column = 5; column < 8; ++column)
    EXPECT_EQ(as_number(table.rows[0][column]), 1.0);
}

TEST_F(Compare, RunsThatAreTheSameAreSaidToBe) {
  ASSERT_EQ(run({"-o", "a"}).exit_code, 0);
  std::filesystem::copy(folder.path / "a", folder.path / "b",
                        std::filesystem::copy_options::recursive);
  const auto outcome = compare({"a", "b", "-o", "c.html"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "the same in all runs: time_s")) << outcome.out;
  EXPECT_FALSE(contains(outcome.out, "differ")) << outcome.out;
}

// Parameters of a program are settings, not results, even if [report] shows them.
TEST_F(Compare, SettingsAreNoResults) {
  write_file(folder.path / "e.toml",
             "[program]\nname = \"message\"\n[report]\ncolumns = [\"bytes\", \"latency_s\"]\n");
  ASSERT_EQ(run({"-o", "short", "--set", "program.bytes=10"}).exit_code, 0);
  ASSERT_EQ(run({"-o", "long", "--set", "program.bytes=20"}).exit_code, 0);
  ASSERT_EQ(run({"-o", "all", "--columns", "all"}).exit_code, 0);
  const auto outcome = compare({"short", "long", "-o", "c.csv"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "program.bytes     10    20")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "\nlatency_s: long is")) << outcome.out;
  EXPECT_FALSE(contains(outcome.out, "\nbytes: ")) << outcome.out;
  EXPECT_FALSE(contains(outcome.out, "bytes at each point")) << outcome.out;
  const auto table = parse_csv(read_file(folder.path / "c.csv"), "c.csv");
  for (const auto& row : table.rows) EXPECT_NE(row[0], Value("bytes"));
  const auto all = compare({"all", "long"});
  ASSERT_EQ(all.exit_code, 0) << all.err;
  EXPECT_FALSE(contains(all.out, "\nbytes: ")) << all.out;
  const auto refused = compare({"short", "long", "--columns", "bytes"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "found the setting bytes")) << refused.err;
}

// Points that were ended early are not compared.
TEST_F(Compare, LeavesOutWhatDidNotComeToItsEnd) {
  ASSERT_EQ(run({"-o", "a"}).exit_code, 0);
  const auto table = parse_csv(read_file(folder.path / "a/results.csv"), "a");
  const auto time = *as_number(table.rows[1][*table.find("time_s")]);
  // the time limit suffices only for the point with three workers
  run({"-o", "b", "--until", fmt::format("{}", 1.5 * time)});
  const auto outcome = compare({"a", "b"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "left out: 1 of 2 rows of b")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "the same in all runs: time_s")) << outcome.out;
}

// The model is an axis in one run and a setting in the other. The axis has the value of the
// setting.
TEST_F(Compare, AnAxisOfOneRunIsASettingOfAnother) {
  ASSERT_EQ(run({"-o", "one"}).exit_code, 0);
  ASSERT_EQ(run({"-o", "two", "--set", "sweep.model=[\"t805-25\",\"t805-30\"]"}).exit_code, 0);
  const auto outcome = compare({"one", "two"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "left out: 2 of 4 rows of two")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "t805-25, t805-30")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "the same in all runs: time_s")) << outcome.out;
}

TEST_F(Compare, RefusesWhatCannotBeCompared) {
  ASSERT_EQ(run({"-o", "a"}).exit_code, 0);
  ASSERT_EQ(run({"-o", "b", "--set", "sweep.workers=[2,4]"}).exit_code, 0);
  ASSERT_EQ(run({"-o", "c", "--set", "scene.objects=10"}).exit_code, 0);
  const auto expect = [&](std::vector<std::string> arguments, const std::string& text) {
    const auto outcome = compare(std::move(arguments));
    EXPECT_EQ(outcome.exit_code, 2) << text;
    EXPECT_TRUE(contains(outcome.err, text)) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path / "o.html"));
  };
  expect({"a"}, "found 1 folder, expected two or more");
  expect({"a", "./a/"}, "found ./a/ twice");
  expect({"a", "none"}, "none: found no run.json");
  expect({"a", "b", "-o", "o.html"}, "workers is 2, 4 in b");
  expect({"a", "c", "--columns", "tme_s", "-o", "o.html"}, "the nearest is \"time_s\"");
  expect({"a", "c", "-o", "o.txt"}, "ends with .html or .csv");
  expect({"a", "c", "-o", "a/report.html"}, "outside the compared results");
  expect({"a", "c", "-o", "a/points/o.html"}, "outside the compared results");
  std::filesystem::create_symlink("a/points/experiment.json", folder.path / "record.csv");
  expect({"a", "c", "-o", "record.csv"}, "outside the compared results");
  expect({"a", "c", "-o", "no/o.html"}, "no/o.html");
  std::filesystem::create_directory_symlink("a", folder.path / "alias");
  expect({"a", "alias"}, "found alias twice");
  auto json = nlohmann::ordered_json::parse(read_file(folder.path / "c/run.json"));
  for (const auto* key : {"models", "inputs", "tlab", "points", "set"}) {
    auto damaged = json;
    damaged[key] = 3;
    write_file(folder.path / "c/run.json", damaged.dump());
    expect({"a", "c", "-o", "o.html"}, "c/run.json");
  }
}

}  // namespace
}  // namespace laboratory
