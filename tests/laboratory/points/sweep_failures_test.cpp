// Sweeps with points that fail, results of another experiment, mistakes in files, and full disks.
#include <signal.h>
#include <sys/resource.h>

#include <new>
#include <nlohmann/json.hpp>

#include "base/partial_name.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_result.hpp"
#include "experiments/laboratory/report/network_drawings.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "tests/laboratory/support/load.hpp"
#include "tests/laboratory/support/sweep.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

// The first and the third point fail for lack of simulated memory.
const char* const SOME_FAIL =
    "[image]\nwidth = 16\nheight = 12\n[[check]]\nname = \"c\"\nof = \"rays\"\nwithin = 1e-9\n"
    "formula = \"rays\"\n[sweep]\n"
    "database_memory_bytes = [146432, 200000000, 146433]\nworkers = [2]\n";

TEST_F(Sweep, PointsThatFailAreNamedAndTheOthersKept) {
  std::ofstream(folder.path / "e.toml") << SOME_FAIL;
  for (const char* jobs : {"1", "3"}) {
    const auto failed = run({"-o", std::string("r") + jobs, "--jobs", jobs});
    EXPECT_EQ(failed.exit_code, 3) << failed.err;
    EXPECT_TRUE(contains(failed.err, "tlab: at database_memory_bytes = 146433, workers = 2: "))
        << failed.err;
    EXPECT_TRUE(contains(failed.err, "2 of 3 point(s) failed, at database_memory_bytes = 146432"))
        << failed.err;
    EXPECT_TRUE(contains(failed.out, "1 of 3 points are done, 2 out of simulated memory"))
        << failed.out;
    EXPECT_TRUE(contains(failed.out, "ok       c: rays at 1 point(s)")) << failed.out;
  }
  EXPECT_EQ(visible("r1"), visible("r3"));
  const auto table = parse_csv(visible("r1")["results.csv"], "results.csv");
  ASSERT_EQ(table.rows.size(), 3u);
  for (std::size_t row = 0; row < 3; ++row) {
    const bool fails = row != 1;
    EXPECT_EQ(to_string(table.rows[row][*table.find("ended")]), fails ? "out of memory" : "done");
    EXPECT_EQ(to_string(table.rows[row][*table.find("time_s")]) == "", fails);
    EXPECT_EQ(to_string(table.rows[row][*table.find("objects")]), "200");
  }
  const auto json = nlohmann::json::parse(read_file(folder.path / "r1/run.json"));
  EXPECT_EQ(json["complete"], false);
  EXPECT_TRUE(contains(json["points"][0]["message"], "out of memory"));
  EXPECT_TRUE(json["points"][1].contains("use"));
  // Failed points are simulated again. With --point, the exit code is that of the chosen point.
  EXPECT_TRUE(contains(run({"-o", "r1", "--list"}).out, "workers = 2\tthere"));
  const auto again = run({"-o", "r1"});
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_TRUE(contains(again.out, "1 of 3 points were already recorded")) << again.out;
  EXPECT_EQ(run({"-o", "r1", "--point", "0"}).exit_code, 3);
  EXPECT_EQ(run({"-o", "r1", "--point", "1"}).exit_code, 0);
  EXPECT_EQ(tlab(folder.path, {"merge", "r1"}).exit_code, 2);
  EXPECT_EQ(visible("r1"), visible("r3"));
  EXPECT_EQ(tlab(folder.path, {"report", "r1"}).exit_code, 0);
  EXPECT_EQ(visible("r1"), visible("r3"));
}

TEST(PointFailures, AHostWithoutMemoryIsNoDefectOfOurs) {
  const auto failure = make_failure(std::bad_alloc());
  ASSERT_TRUE(failure);
  EXPECT_EQ(failure->exit_code, 2);
  EXPECT_EQ(failure->message, "the host is out of memory");
}

// Only drawings of the faults are written, beside the folder.
TEST_F(Sweep, NoResultsAreWrittenIfAllPointsFail) {
  std::ofstream(folder.path / "e.toml") << SOME_FAIL;
  const auto failed = run({"-o", "r", "--set", "sweep.database_memory_bytes=[146432, 146433]"});
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_TRUE(contains(failed.err, "2 of 2 point(s) failed")) << failed.err;
  EXPECT_TRUE(contains(failed.err, "no results were written")) << failed.err;
  EXPECT_EQ(folder.names(),
            (Arguments{"e.toml", "r-fault-database-memory-bytes-146432-workers-2-timeline.svg",
                       "r-fault-database-memory-bytes-146433-workers-2-timeline.svg"}));
}

// The first point fails. The second has the same images, so the report and the key images come from
// it.
TEST_F(Sweep, KeyImagesOutliveAPointThatFails) {
  ASSERT_EQ(run({"-o", "whole", "--set", "sweep.objects=[20]"}).exit_code, 0);
  write_file(folder.path / "e.toml",
             "[image]\nwidth = 12\nheight = 8\n[[stage]]\nmin_cell = 4\n[[stage]]\n[scene]\n"
             "objects = 20\n[sweep]\ndatabase_memory_bytes = [132000, 200000000]\n");
  EXPECT_EQ(run({"-o", "r"}).exit_code, 3);
  EXPECT_EQ(visible("r")["image-spheres-20-stage1.png"],
            visible("whole")["image-spheres-20-stage1.png"]);
  EXPECT_TRUE(contains(visible("r")["report.html"], "spheres-20-stage1, after"));
}

// Images without a record may belong to another process that has not written its record yet.
TEST_F(Sweep, ImagesOfOtherProcessesStay) {
  write_file(folder.path / "e.toml", SOME_FAIL);
  ASSERT_EQ(run({"-o", "r", "--point", "1"}).exit_code, 0);
  for (const auto& record : records("r")) fs::remove(record);
  const auto count = [&] {
    return std::distance(fs::recursive_directory_iterator(folder.path / "r/points"),
                         fs::recursive_directory_iterator());
  };
  const auto before = count();
  EXPECT_EQ(run({"-o", "r", "--point", "0"}).exit_code, 3);
  EXPECT_EQ(count(), before);
}

// A defect of tlab has precedence over a fault of the simulated program, whichever point fails
// first.
TEST(ExperimentsFailures, OfSeveralTheLowestExitCodeCounts) {
  const auto file = load("[sweep]\nworkers = [1, 2, 3]\n");
  const auto code_of = [&](const std::vector<int>& codes) {
    Results results(3);
    for (std::size_t i = 0; i < 3; ++i) {
      results[i].ended = codes[i] == 0 ? "done" : "failed";
      results[i].exit_code = codes[i];
      if (codes[i] != 0) results[i].message = "why";
    }
    try {
      throw_failures(file, results, "nowhere");
    } catch (const Failure& failure) {
      return failure.exit_code;
    }
    return 0;
  };
  EXPECT_EQ(code_of({0, 0, 0}), 0);
  EXPECT_EQ(code_of({0, 3, 3}), 3);
  EXPECT_EQ(code_of({0, 1, 0}), 1);
  EXPECT_EQ(code_of({3, 1, 3}), 1);
  EXPECT_EQ(code_of({1, 3, 3}), 1);
  EXPECT_EQ(code_of({3, 3, 1}), 1);
}

TEST_F(Sweep, DeadlocksAreReportedPointByPoint) {
  std::ofstream(folder.path / "e.toml")
      << "[program]\nname = \"deadlock\"\n[sweep]\n\"model.cpu.clock\" = [20e6, 25e6]\n";
  const auto failed = run({"-o", "r"});
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_TRUE(contains(failed.err, "tlab: at cpu.clock = ")) << failed.err;
  EXPECT_TRUE(contains(failed.err, "deadlock at 0.")) << failed.err;
  EXPECT_FALSE(fs::exists(folder.path / "r"));
}

TEST_F(Sweep, ResultsOfAnotherExperimentAreNotTouched) {
  ASSERT_EQ(run({"-o", "r", "--set", "title=\"first\""}).exit_code, 0);
  const auto before = visible("r");
  fs::create_directory(folder.path / "deep");
  std::ofstream(folder.path / "other.toml") << SWEEP;
  std::ofstream(folder.path / "deep/e.toml") << "title = \"second\"\n" << SWEEP;
  for (const auto& [file, told] :
       {std::pair("other.toml", "of the experiment \"e\" (first), but this one is \"other\""),
        std::pair("deep/e.toml", "\"e\" (first), but this one is \"e\" (second)")})
    for (const Arguments& more :
         {Arguments{"run", file, "-o", "r"}, Arguments{"run", file, "-o", "r", "--point", "0"},
          Arguments{"verify", file, "-o", "r"}}) {
      const auto refused = tlab(folder.path, more);
      EXPECT_EQ(refused.exit_code, 2) << file;
      EXPECT_TRUE(contains(refused.err, told)) << refused.err;
      EXPECT_EQ(visible("r"), before);
    }
  // Results are accepted for the same file with another title, and by any experiment if they name
  // no experiment.
  EXPECT_EQ(run({"-o", "r"}).exit_code, 0);
  fs::remove_all(folder.path / "r/points");
  EXPECT_EQ(tlab(folder.path, {"run", "other.toml", "-o", "r"}).exit_code, 2);
  std::ofstream(folder.path / "r/run.json") << "{\"tlab\": \"0.0.9\"}";
  EXPECT_EQ(tlab(folder.path, {"run", "other.toml", "-o", "r"}).exit_code, 0);
}

// The folder already has records of all points of other.toml, so a run would write no record. The
// experiments must be compared before the run.
TEST_F(Sweep, AnotherExperimentWithTheSamePointsIsRefused) {
  std::ofstream(folder.path / "other.toml") << "title = \"other\"\n" << SWEEP;
  ASSERT_EQ(run({"-o", "r"}).exit_code, 0);
  const auto before = visible("r");
  const auto refused = tlab(folder.path, {"run", "other.toml", "-o", "r"});
  EXPECT_EQ(refused.exit_code, 2);
  EXPECT_TRUE(contains(refused.err, "found results of the experiment")) << refused.err;
  EXPECT_EQ(visible("r"), before);
}

// A results folder that the user has made remains. A folder that the run has made is removed if the
// run fails.
TEST_F(Sweep, AFolderThatWasThereOutlivesARunThatFails) {
  std::ofstream(folder.path / "e.toml") << "[program]\nname = \"deadlock\"\n";
  fs::create_directory(folder.path / "made");
  for (const char* name : {"made", "new"}) EXPECT_EQ(run({"-o", name}).exit_code, 3);
  EXPECT_EQ(folder.names(),
            (Arguments{"e.toml", "made", "made-fault-timeline.svg", "made-fault.svg",
                       "new-fault-timeline.svg", "new-fault.svg"}));
}

// The process that writes the first record owns the folder. The other process fails at its first
// record.
TEST_F(Sweep, OfTwoExperimentsStartedAtOnceOneHasTheFolder) {
  std::ofstream(folder.path / "other.toml") << "title = \"other\"\n" << SWEEP;
  for (int i = 0; i < 5; ++i) {
    const auto name = "r" + std::to_string(i);
    fs::create_directories(folder.path / "a");
    fs::create_directories(folder.path / "b");
    const pid_t first = start_tlab(folder.path / "a", {"run", "../e.toml", "-o", "../" + name});
    const pid_t second =
        start_tlab(folder.path / "b", {"run", "../other.toml", "-o", "../" + name});
    const Outcome a = wait_for_tlab(folder.path / "a", first);
    const Outcome b = wait_for_tlab(folder.path / "b", second);
    EXPECT_EQ(a.exit_code + b.exit_code, 2) << a.err << b.err;
    const auto& refused = a.exit_code == 2 ? a : b;
    EXPECT_TRUE(contains(refused.err, "found results of the experiment")) << refused.err;
    const auto run = nlohmann::json::parse(read_file(folder.path / name / "run.json"));
    EXPECT_EQ(run["name"], a.exit_code == 2 ? "other" : "e");
    EXPECT_EQ(records(name).size(), 6u);
  }
  for (const auto& name : folder.names()) EXPECT_FALSE(name.starts_with('.')) << name;
}

// Half-written records of killed processes are removed. Those of running processes remain.
TEST_F(Sweep, HalfWrittenRecordsOfKilledProcessesGo) {
  ASSERT_EQ(run({"-o", "r", "--point", "0-5"}).exit_code, 0);
  const auto store = records("r")[0].parent_path();
  const auto dead = store / (base::make_partial_name("k.json", "partial", 0x3ffffff) + "-1");
  const auto alive = store / (base::make_partial_name("k.json", "partial", getpid()) + "-1");
  for (const auto& path : {dead, alive}) std::ofstream(path) << "{";
  ASSERT_EQ(run({"-o", "r", "--point", "0"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(dead));
  EXPECT_TRUE(fs::exists(alive));
}

// While the object lives, the first program of this name on PATH is one that always fails.
class Failing {
 public:
  Failing(const fs::path& folder, const char* name) {
    fs::create_directory(folder);
    write_file(folder / name, "#!/bin/sh\necho 'no drawing today' >&2\nexit 5\n");
    fs::permissions(folder / name, fs::perms::owner_all);
    setenv("PATH", (folder.string() + ":" + path_).c_str(), 1);
  }
  ~Failing() { setenv("PATH", path_.c_str(), 1); }

 private:
  const std::string path_ = std::getenv("PATH");
};

// tlab calls neato only for graphs from users' files. This network therefore comes from a file.
TEST_F(Sweep, DrawingsThatFailCostNoResults) {
  if (!is_gnuplot_installed()) GTEST_SKIP() << "no gnuplot";
  write_file(folder.path / "own.dot", "graph { 0 -- 1; 1 -- 2; 2 -- 0; 2 -- 3; }");
  write_file(folder.path / "e.toml",
             "[network]\ntopology = \"own.dot\"\n[image]\nwidth = 12\nheight = 8\n"
             "[sweep]\nobjects = [9, 20]\n"
             "[[check]]\nname = \"c\"\nof = \"rays\"\nwithin = 1e-9\nformula = \"rays\"\n"
             "[[plot]]\nname = \"rays\"\nx = \"objects\"\ny = \"rays\"\n");
  for (const char* program : {"gnuplot", "neato"}) {
    {
      const Failing failing(folder.path / program, program);
      const Arguments all{"run", "e.toml", "-o", "r", "--set", "report.networks=largest"};
      const auto failed = tlab(folder.path, all);
      EXPECT_EQ(failed.exit_code, 2);
      EXPECT_TRUE(contains(failed.err, "no drawing today")) << failed.err;
      EXPECT_TRUE(contains(failed.err, program == std::string("gnuplot")
                                           ? "tlab: plot rays: gnuplot failed (exit code 5)"
                                           : "tlab: network at objects = 20: "))
          << failed.err;
      EXPECT_TRUE(contains(failed.err,
                           "the other results are in r; repeat the drawings with tlab report r"));
      EXPECT_TRUE(contains(failed.out, "all 2 points are done")) << failed.out;
      EXPECT_TRUE(contains(visible("r")["report.html"], "not drawn: ")) << program;
      EXPECT_EQ(tlab(folder.path, {"report", "r"}).exit_code, 2);
      EXPECT_EQ(
          tlab(folder.path, {"verify", "e.toml", "-o", "r", "--set", "report.networks=largest"})
              .exit_code,
          2)
          << program;
    }
    EXPECT_EQ(tlab(folder.path, {"report", "r"}).exit_code, 0);
    EXPECT_FALSE(contains(visible("r")["report.html"], "not drawn: "));
    fs::remove_all(folder.path / "r");
  }
}

// A failed check has precedence over a failed drawing. Both are reported.
TEST_F(Sweep, ADrawingThatFailsHidesNoCheck) {
  const Failing failing(folder.path / "bin", "gnuplot");
  const auto failed = run({"-o", "r", "--set", "check=[{name=\"c\", of=\"rays\", at_most=1}]"});
  EXPECT_EQ(failed.exit_code, 1) << failed.err;
  EXPECT_TRUE(contains(failed.err, "1 of 1 check(s) do not hold")) << failed.err;
  const std::string told = "tlab: plot speedup: gnuplot failed (exit code 5): no drawing today";
  EXPECT_TRUE(contains(failed.err, told)) << failed.err;
}

TEST_F(Sweep, ARecordThatCannotBeReadCostsItsDrawingAlone) {
  ASSERT_EQ(run({"-o", "r", "--set", "report.networks=all"}).exit_code, 0);
  const auto results = folder.path / "r";
  const auto simulation = load_simulation(results, load_origin(results, "run.json").file);
  const auto networks = visible("r").size();
  fs::remove_all(results / "networks");
  write_file(results / simulation.records.front(), "{");
  RunOptions options;
  options.jobs = 2;
  const auto drawn = draw_networks(results, options, simulation);
  ASSERT_EQ(drawn.failures.size(), 1u);
  EXPECT_TRUE(drawn.failures[0].starts_with("network at objects = 20, workers = 1: "))
      << drawn.failures[0];
  EXPECT_EQ(visible("r").size(), networks - 1);
}

// An unknown name of a column is noticed after the first point, whose result is kept.
TEST_F(Sweep, ATypoInACheckCostsNoPoint) {
  const auto mistaken = run({"-o", "r", "--jobs", "1", "--set", "let={half=\"rayz / 2\"}", "--set",
                             "check=[{name=\"c\", of=\"rays\", within=1, formula=\"half\"}]"});
  EXPECT_EQ(mistaken.exit_code, 2);
  EXPECT_TRUE(contains(mistaken.err, "rayz")) << mistaken.err;
  EXPECT_EQ(records("r").size(), 0u) << "found before the first point was simulated";
  const auto mended = run({"-o", "r"});
  EXPECT_EQ(mended.exit_code, 0) << mended.err;
}

TEST_F(Sweep, MistakesAreNamed) {
  for (const auto& [more, told] : std::vector<std::pair<Arguments, std::string>>{
           {{"--point", "6"}, "--point 6: expected the number of a point, or two such as 0-9"},
           {{"--point", "5-4"}, "--point 5-4"},
           {{"--point", "0-6"}, "from 0 to 5"},
           {{"--point", "-1"}, "--point"},
           {{"--point", "one"}, "--point one"},
           {{"--point", "0", "--set", "run.cost=timed"}, "found cost = \"timed\""},
           {{"--jobs", "0"}, "--jobs"},
           {{"--set", "sweep.workers=[]"}, "at least one"},
           {{"--set", "farm.max_cell=3"}, "e.toml: farm.max_cell: found 3"},
           {{"--set", "farm.task=block:2x2"}, "e.toml: farm.task: found a block"},
           {{"--set", "network.topology=hypercube"}, "e.toml: network.workers: found 3"},
           {{"--set", "title=a\x8a"}, "--set title=a\\x8a: found bytes that are not UTF-8"},
           {{"--list", "--set", "model.link.bits=1"},
            "e.toml: [model]: model.link.bits: unknown key"},
           {{"--list", "--point", "0"}, "--list"}}) {
    auto arguments = more;
    arguments.insert(arguments.end(), {"-o", "r"});
    const auto done = run(arguments);
    EXPECT_EQ(done.exit_code, 2) << told << done.out;
    EXPECT_TRUE(contains(done.err, told)) << told << "\n" << done.err;
  }
  EXPECT_EQ(tlab(folder.path, {"merge", "r"}).exit_code, 2);
  EXPECT_EQ(tlab(folder.path, {"report", "r"}).exit_code, 2);
  EXPECT_EQ(folder.names(), Arguments{"e.toml"});
}

// JSON cannot contain the file's name, so the file is refused before any simulation.
TEST_F(Sweep, AFileWhoseNameIsNoUtf8IsRefused) {
  const std::string name = "e\xff.toml", folder_name = "f\xff";
  fs::copy(folder.path / "e.toml", folder.path / name);
  fs::create_directory(folder.path / folder_name);
  fs::copy(folder.path / "e.toml", folder.path / folder_name / "e.toml");
  for (const auto& file : {name, folder_name + "/e.toml"}) {
    const auto done = tlab(folder.path, {"run", file, "-o", "r"});
    EXPECT_EQ(done.exit_code, 2);
    EXPECT_TRUE(contains(done.err, "\\xff")) << done.err;
    EXPECT_TRUE(contains(done.err, "found a name that is not UTF-8")) << done.err;
  }
  EXPECT_FALSE(fs::exists(folder.path / "r"));
}

// Simulates a full disk: no file may become larger than `bytes`.
Outcome run_with_limit(const fs::path& folder, const Arguments& arguments, rlim_t bytes) {
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  const rlimit limit{bytes, old.rlim_max};
  signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &limit);
  const auto outcome = tlab(folder, arguments);
  setrlimit(RLIMIT_FSIZE, &old);
  return outcome;
}

TEST_F(Sweep, ADiskThatFillsLosesNothing) {
  ASSERT_EQ(run({"-o", "r", "--set", "sweep.workers=[5]"}).exit_code, 0);
  const auto before = visible("r");
  const auto full = run_with_limit(folder.path, {"run", "e.toml", "-o", "r"}, 12'000);
  EXPECT_EQ(full.exit_code, 2);
  EXPECT_TRUE(contains(full.err, "File too large")) << full.err;
  EXPECT_TRUE(contains(full.err, (folder.path / "r/").string())) << full.err;
  EXPECT_EQ(visible("r"), before);
  EXPECT_EQ(records("r").size(), 8u);
  const auto none = run_with_limit(folder.path, {"run", "e.toml", "-o", "s"}, 100);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_TRUE(contains(none.err, "s/points/")) << none.err;
  const auto resumed = run({"-o", "r"});
  EXPECT_TRUE(contains(resumed.out, "6 of 6 points were already recorded")) << resumed.out;
}

}  // namespace
}  // namespace laboratory
