// `tlab run --uncertain`: its files and its refusals.
#include <fmt/format.h>

#include "experiments/laboratory/table/table.hpp"
#include "tests/laboratory/support/tlab.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

// Two points: one worker, and three workers.
const std::string TWO_POINTS =
    "[network]\n[scene]\nobjects = 20\n[image]\nwidth = 16\nheight = 12\n[run]\nengine = "
    "\"direct\"\n[sweep]\nworkers = [1, 3]\n";

struct Uncertain : testing::Test {
  Uncertain() { write_file(folder.path / "e.toml", TWO_POINTS); }
  Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"run", "e.toml"});
    return tlab(folder.path, std::move(arguments));
  }
  std::string read(const std::string& path) const { return read_file(folder.path / path); }
  TemporaryFolder folder;
};

TEST_F(Uncertain, LeavesTheResultsAsTheyAreAndTheirIntervalsBeside) {
  ASSERT_EQ(run({"-o", "plain"}).exit_code, 0);
  const auto outcome = run({"--uncertain", "48", "-o", "sure"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(read("plain/results.csv"), read("sure/results.csv"));
  EXPECT_FALSE(fs::exists(folder.path / "plain/intervals.csv"));
  EXPECT_TRUE(contains(outcome.out, "time_s: ± ")) << outcome.out;
  EXPECT_TRUE(contains(outcome.out, "matters most")) << outcome.out;
  EXPECT_TRUE(contains(read("sure/report.html"), "Uncertainty of these results"));
  const auto intervals = parse_csv(read("sure/intervals.csv"), "intervals");
  std::size_t times = 0;
  for (const auto& row : intervals.rows) {
    const auto number = [&](const char* column) {
      return *as_number(row[*intervals.find(column)]);
    };
    EXPECT_LE(number("p5"), number("p50"));
    EXPECT_LE(number("p50"), number("p95"));
    if (to_string(row[*intervals.find("column")]) != "time_s") continue;
    ++times;
    EXPECT_GT(number("p95"), number("p5"));
    EXPECT_LT(number("p5"), 1.1 * number("value"));
    EXPECT_GT(number("p95"), 0.9 * number("value"));
  }
  EXPECT_EQ(times, 2u);
  EXPECT_TRUE(contains(read("sure/assumptions.csv"), "scale.intersection"));
}

TEST_F(Uncertain, GivesTheSameBytesWithAnyJobsAndHowevOftenItIsResumed) {
  ASSERT_EQ(run({"--uncertain", "6", "--jobs", "1", "-o", "a"}).exit_code, 0);
  // Simulates some points first, as jobs on a cluster do, and then the rest.
  for (const auto* points : {"0-3", "9-11"})
    ASSERT_EQ(run({"--uncertain", "6", "--point", points, "-o", "b"}).exit_code, 0);
  const auto outcome = run({"--uncertain", "6", "--jobs", "2", "-o", "b"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_TRUE(contains(outcome.out, "7 of 14 points were already recorded")) << outcome.out;
  for (const auto* file : {"results.csv", "intervals.csv", "assumptions.csv"})
    EXPECT_EQ(read("a/" + std::string(file)), read("b/" + std::string(file))) << file;
  ASSERT_EQ(run({"--uncertain", "6", "--point", "0-13", "-o", "c"}).exit_code, 0);
  ASSERT_EQ(tlab(folder.path, {"merge", "c"}).exit_code, 0);
  EXPECT_EQ(read("a/intervals.csv"), read("c/intervals.csv"));
  const auto page = read("b/report.html");
  ASSERT_EQ(tlab(folder.path, {"report", "b"}).exit_code, 0);
  EXPECT_EQ(read("a/intervals.csv"), read("b/intervals.csv"));
  EXPECT_EQ(run({"--uncertain", "6", "-o", "b"}).exit_code, 0);  // the run replaces its own results
  EXPECT_EQ(page, read("b/report.html"));
}

TEST_F(Uncertain, KilledItGoesOnToTheSameBytes) {
  ASSERT_EQ(run({"--uncertain", "6", "-o", "a"}).exit_code, 0);
  const auto count_records = [&] {  // finished records, which are never removed
    std::size_t count = 0;
    const auto points = folder.path / "b/points";
    if (!fs::exists(points)) return count;
    for (const auto& file : fs::recursive_directory_iterator(points))
      count += file.path().extension() == ".json";
    return count;
  };
  for (const std::size_t wanted : {1, 5, 9}) {
    const pid_t pid =
        start_tlab(folder.path, {"run", "e.toml", "--uncertain", "6", "--jobs", "1", "-o", "b"});
    for (int i = 0; i < 30'000 && count_records() < wanted; ++i) usleep(1000);
    kill(pid, SIGKILL);
    int status = 0;
    waitpid(pid, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it ended by itself: " << status;
    EXPECT_GE(count_records(), wanted);
  }
  ASSERT_EQ(run({"--uncertain", "6", "-o", "b"}).exit_code, 0);
  for (const auto* file : {"results.csv", "intervals.csv", "assumptions.csv"})
    EXPECT_EQ(read("a/" + std::string(file)), read("b/" + std::string(file))) << file;
}

// On any machine, three workers are faster than one. The two networks with one worker are equally
// fast.
TEST_F(Uncertain, SaysOnHowManyMachinesARankingHolds) {
  write_file(folder.path / "e.toml",
             TWO_POINTS +
                 "topology = [\"tree\", \"line\"]\n"
                 "[[best]]\nname = \"fastest\"\nof = \"time_s\"\nleast = true\nover = "
                 "[\"workers\"]\n"
                 "[[best]]\nname = \"network\"\nof = \"time_s\"\nleast = true\nover = "
                 "[\"topology\"]\n");
  const auto outcome = run({"--uncertain", "6", "-o", "a"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const auto rankings = parse_csv(read("a/rankings.csv"), "rankings");
  ASSERT_EQ(rankings.rows.size(), 4u);
  for (const auto& row : rankings.rows) {
    EXPECT_EQ(to_string(row[*rankings.find("of")]), "6");
    const auto question = to_string(row[*rankings.find("question")]);
    const auto best = to_string(row[*rankings.find("best")]);
    const auto at = to_string(row[*rankings.find("at")]);
    const auto machines = as_number(row[*rankings.find("machines")]).value();
    if (question == "fastest") {
      EXPECT_EQ(best, "3 workers");
      EXPECT_EQ(machines, 6);
    } else if (at == "workers = 1") {
      EXPECT_EQ(best, "tree or line");
      EXPECT_EQ(machines, 6);
    } else {
      const auto others = to_string(row[*rankings.find("others")]);
      EXPECT_EQ(machines == 6, others.empty()) << others;
    }
  }
  EXPECT_TRUE(contains(outcome.out, "fastest: the same is best on all 6 machines in 2 of 2 cases"))
      << outcome.out;
  EXPECT_TRUE(contains(read("a/report.html"), "best on machines"));
  const auto page = read("a/report.html");
  ASSERT_EQ(tlab(folder.path, {"report", "a"}).exit_code, 0);
  EXPECT_EQ(page, read("a/report.html"));
}

TEST_F(Uncertain, AnotherSeedDrawsOtherMachines) {
  ASSERT_EQ(run({"--uncertain", "6", "-o", "a"}).exit_code, 0);
  ASSERT_EQ(run({"--uncertain", "6", "--seed", "2", "-o", "b"}).exit_code, 0);
  EXPECT_EQ(read("a/results.csv"), read("b/results.csv"));
  EXPECT_NE(read("a/intervals.csv"), read("b/intervals.csv"));
}

TEST_F(Uncertain, AChecksCoverIsJudgedWhereMachinesAreDrawn) {
  const auto check = [](double expected) {
    return fmt::format(
        "[[check]]\nname = \"c\"\nof = \"time_s\"\nformula = \"{}\"\nwhere = \"workers == "
        "1\"\nwithin = 100\ncovers = 0.9\n",
        expected);
  };
  ASSERT_EQ(run({"-o", "plain"}).exit_code, 0);
  const auto table = parse_csv(read("plain/results.csv"), "results");
  const double time = *as_number(table.rows[0][*table.find("time_s")]);
  write_file(folder.path / "e.toml", TWO_POINTS + check(1.005 * time));
  const auto met = run({"--uncertain", "16", "-o", "met"});
  EXPECT_EQ(met.exit_code, 0) << met.out << met.err;
  EXPECT_TRUE(contains(met.out, "1 of 1 where nine of ten machines are (at least 90 %)"))
      << met.out;
  write_file(folder.path / "e.toml", TWO_POINTS + check(2 * time));
  EXPECT_EQ(run({"-o", "far"}).exit_code, 0);
  const auto far = run({"--uncertain", "16", "-o", "far"});
  EXPECT_EQ(far.exit_code, 1) << far.out;
  EXPECT_TRUE(contains(far.out, "FAILED   c")) << far.out;
}

TEST_F(Uncertain, WhatIsSetIsNotDrawn) {
  const auto assumptions = [&](const std::string& setting) {
    const auto outcome =
        run({"--uncertain", "24", "--set", "sweep.workers=[1]", "--set", setting, "-o", "a"});
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return read("a/assumptions.csv");
  };
  EXPECT_TRUE(contains(assumptions("scene.objects=20"), ",scale.intersection,"));
  EXPECT_FALSE(contains(assumptions("model.scale.intersection=11.59"), ",scale.intersection,"));
}

TEST_F(Uncertain, RefusesWhatIsNoNumberOfMachines) {
  for (const auto& [set, text] :
       {std::pair("1", "expected"), {"0", "expected"}, {"x", "expected"}, {"1e9", "expected"}}) {
    const auto outcome = run({"--uncertain", set});
    EXPECT_EQ(outcome.exit_code, 2) << set;
    EXPECT_TRUE(contains(outcome.err, "--uncertain")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, text)) << outcome.err;
  }
  EXPECT_EQ(run({"--seed", "2"}).exit_code, 2);
  write_file(folder.path / "e.toml", TWO_POINTS + "[uncertain]\nseed = 2\n");
  EXPECT_TRUE(contains(run({}).err, "machines = N"));
}

}  // namespace
}  // namespace laboratory
