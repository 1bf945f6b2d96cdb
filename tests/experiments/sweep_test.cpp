// Sweeps in parts: records of points, runs that are resumed, merged, or have points that fail.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "experiments/point_key.hpp"
#include "experiments/table.hpp"
#include "tests/experiments/load.hpp"
#include "tests/experiments/tlab.hpp"

namespace experiments {
namespace {

namespace fs = std::filesystem;
using Arguments = std::vector<std::string>;

// Six points with two images, key images and a check.
const char* const SWEEP =
    "[image]\nwidth = 12\nheight = 8\n[[stage]]\nmin_cell = 4\n[[stage]]\n"
    "[[check]]\nname = \"c\"\nof = \"rays\"\nwithin = 1e-9\nformula = \"rays\"\n"
    "[sweep]\nobjects = [20, 9]\nworkers = [1, 3, 2]\n";

struct Sweep : testing::Test {
  Sweep() { std::ofstream(folder.path / "e.toml") << SWEEP; }

  Outcome run(Arguments more) {
    more.insert(more.begin(), {"run", "e.toml"});
    return tlab(folder.path, more);
  }
  // Everything in a folder of results that people look at: name -> bytes.
  std::map<std::string, std::string> visible(const std::string& name) const {
    std::map<std::string, std::string> files;
    const auto root = folder.path / name;
    for (const auto& entry : fs::recursive_directory_iterator(root)) {
      const auto path = fs::relative(entry.path(), root).string();
      if (entry.is_regular_file() && !path.starts_with("points") && path != "run.json")
        files[path] = read_file(entry.path());
    }
    return files;
  }
  std::vector<fs::path> records(const std::string& name) const {
    std::vector<fs::path> found;
    const auto points = folder.path / name / "points";
    if (!fs::exists(points)) return found;
    for (const auto& entry : fs::recursive_directory_iterator(points))
      if (entry.path().extension() == ".json" && entry.path().stem() != "experiment")
        found.push_back(entry.path());
    std::ranges::sort(found);
    return found;
  }
  TemporaryFolder folder;
};

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Sweep, AnyHistoryGivesTheSameBytes) {
  ASSERT_EQ(run({"-o", "once", "--jobs", "1"}).exit_code, 0);
  const auto expected = visible("once");
  EXPECT_TRUE(expected.contains("image-spheres-9-stage1.png"));
  EXPECT_TRUE(expected.contains("checks.csv"));

  ASSERT_EQ(run({"-o", "merged", "--point", "4"}).exit_code, 0);
  const auto early = tlab(folder.path, {"merge", "merged"});
  EXPECT_EQ(early.exit_code, 2);
  EXPECT_TRUE(contains(early.err, "merged: 5 of 6 points are missing")) << early.err;
  EXPECT_TRUE(contains(early.err, "1  objects = 20, workers = 3")) << early.err;
  ASSERT_EQ(run({"-o", "merged", "--point", "0-2", "--point", "5", "--point", "3"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(folder.path / "merged/results.csv"));
  const auto merged = tlab(folder.path, {"merge", "merged"});
  EXPECT_EQ(merged.exit_code, 0) << merged.err;
  EXPECT_EQ(visible("merged"), expected);

  ASSERT_EQ(run({"-o", "resumed", "--point", "2-3"}).exit_code, 0);
  const auto resumed = run({"-o", "resumed", "--jobs", "3"});
  EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
  EXPECT_TRUE(contains(resumed.out, "2 of 6 points were there")) << resumed.out;
  EXPECT_EQ(visible("resumed"), expected);

  fs::remove_all(folder.path / "resumed/plots");
  std::ofstream(folder.path / "resumed/report.html") << "old";
  const auto report = tlab(folder.path, {"report", "resumed"});
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_EQ(visible("resumed"), expected);
}

TEST_F(Sweep, ALargerOneRunsOnlyWhatIsNew) {
  ASSERT_EQ(run({"-o", "r"}).exit_code, 0);
  const auto before = visible("r");
  const auto larger = run({"-o", "r", "--set", "sweep.workers=[1, 2, 3, 4]"});
  EXPECT_TRUE(contains(larger.out, "6 of 8 points were there")) << larger.out;
  const auto smaller = run({"-o", "r", "--set", "sweep.workers=[1, 4]"});
  EXPECT_TRUE(contains(smaller.out, "4 of 4 points were there")) << smaller.out;
  EXPECT_TRUE(contains(run({"-o", "r"}).out, "6 of 6 points were there"));
  EXPECT_EQ(visible("r"), before);
  EXPECT_EQ(records("r").size(), 8u);
}

TEST_F(Sweep, PointsAreListed) {
  ASSERT_EQ(run({"-o", "r", "--point", "1"}).exit_code, 0);
  const auto list = run({"-o", "r", "--list"});
  EXPECT_EQ(list.exit_code, 0) << list.err;
  EXPECT_EQ(std::ranges::count(list.out, '\n'), 6);
  EXPECT_TRUE(list.out.starts_with("0\t")) << list.out;
  const auto key = records("r").at(0).stem().string();
  EXPECT_TRUE(contains(list.out, "\n1\t" + key + "\tobjects = 20, workers = 3\tthere\n"))
      << list.out;
  EXPECT_TRUE(contains(list.out, "\tobjects = 9, workers = 2\tmissing\n")) << list.out;
}

TEST_F(Sweep, DamagedRecordsAreNamedAndRunAgain) {
  ASSERT_EQ(run({"-o", "r"}).exit_code, 0);
  const auto expected = visible("r");
  const auto files = records("r");
  ASSERT_EQ(files.size(), 6u);
  const auto whole = read_file(files[0]);
  write_file(files[0], std::string_view(whole).substr(0, whole.size() / 2));
  write_file(files[1], read_file(files[2]));  // of another point
  auto changed = read_file(files[3]);
  ++changed[changed.size() / 2];
  write_file(files[3], changed);
  write_file(files[4], "");
  const auto again = run({"-o", "r"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(contains(again.out, "2 of 6 points were there")) << again.out;
  for (int i : {0, 1, 3, 4})
    EXPECT_TRUE(contains(again.err, files[i].filename().string() + ": this record is damaged"))
        << again.err;
  EXPECT_EQ(visible("r"), expected);
  EXPECT_EQ(run({"-o", "r"}).err, "");
}

TEST_F(Sweep, RecordsOfOtherProgramsGoWhenResultsAreWritten) {
  ASSERT_EQ(run({"-o", "r", "--point", "0"}).exit_code, 0);
  const auto other = folder.path / "r/points/0123456789abcdef";
  fs::create_directory(other);
  fs::copy(records("r").at(0), other);
  EXPECT_EQ(run({"-o", "r", "--point", "1"}).exit_code, 0);
  EXPECT_TRUE(fs::exists(other));
  EXPECT_EQ(run({"-o", "r"}).exit_code, 0);
  EXPECT_FALSE(fs::exists(other));
  EXPECT_EQ(records("r").size(), 6u);
}

// Starts tlab in the background.
pid_t start(const fs::path& folder, const Arguments& arguments) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  Arguments all{"tlab"};
  all.insert(all.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& a : all) argv.push_back(a.data());
  if (chdir(folder.c_str()) != 0 || !freopen("/dev/null", "w", stdout)) _exit(99);
  _exit(run_tlab(static_cast<int>(argv.size()), argv.data()));
}

TEST_F(Sweep, KilledAndResumedAtAnyMomentGivesTheSameBytes) {
  ASSERT_EQ(run({"-o", "once"}).exit_code, 0);
  const auto expected = visible("once");
  for (const std::size_t wanted : {1, 4, 6}) {
    const auto name = fmt::format("r{}", wanted);
    const pid_t pid = start(folder.path, {"run", "e.toml", "-o", name, "--jobs", "1"});
    int status = 0;
    for (int i = 0; i < 30'000 && records(name).size() < wanted; ++i) usleep(1000);
    kill(pid, SIGKILL);
    waitpid(pid, &status, 0);
    const auto resumed = run({"-o", name});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_FALSE(contains(resumed.err, "damaged")) << resumed.err;
    EXPECT_EQ(visible(name), expected) << wanted;
  }
  EXPECT_EQ(folder.names(), (Arguments{"e.toml", "once", "r1", "r4", "r6"}));
}

TEST_F(Sweep, SeveralProcessesShareAFolder) {
  std::vector<pid_t> children;
  for (const char* point : {"0-2", "1-4", "5", "3-5"})
    children.push_back(
        start(folder.path, {"run", "e.toml", "-o", "r", "--point", point, "--jobs", "1"}));
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(tlab(folder.path, {"merge", "r"}).exit_code, 0);
  ASSERT_EQ(run({"-o", "once"}).exit_code, 0);
  EXPECT_EQ(visible("r"), visible("once"));
}

// The second point deadlocks, or is out of memory.
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
  // Those that failed are tried again; a point alone has its own exit code.
  EXPECT_TRUE(contains(run({"-o", "r1", "--list"}).out, "workers = 2\tthere"));
  const auto again = run({"-o", "r1"});
  EXPECT_EQ(again.exit_code, 3);
  EXPECT_TRUE(contains(again.out, "1 of 3 points were there")) << again.out;
  EXPECT_EQ(run({"-o", "r1", "--point", "0"}).exit_code, 3);
  EXPECT_EQ(run({"-o", "r1", "--point", "1"}).exit_code, 0);
  EXPECT_EQ(tlab(folder.path, {"merge", "r1"}).exit_code, 2);
  EXPECT_EQ(visible("r1"), visible("r3"));
  EXPECT_EQ(tlab(folder.path, {"report", "r1"}).exit_code, 0);
  EXPECT_EQ(visible("r1"), visible("r3"));
}

TEST_F(Sweep, NothingIsWrittenIfAllPointsFail) {
  std::ofstream(folder.path / "e.toml") << SOME_FAIL;
  const auto failed = run({"-o", "r", "--set", "sweep.database_memory_bytes=[146432, 146433]"});
  EXPECT_EQ(failed.exit_code, 3);
  EXPECT_TRUE(contains(failed.err, "2 of 2 point(s) failed")) << failed.err;
  EXPECT_TRUE(contains(failed.err, "nothing was written")) << failed.err;
  EXPECT_EQ(folder.names(), Arguments{"e.toml"});
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
  // Another title of the same file is the same experiment; so are results without a name.
  EXPECT_EQ(run({"-o", "r"}).exit_code, 0);
  fs::remove_all(folder.path / "r/points");
  EXPECT_EQ(tlab(folder.path, {"run", "other.toml", "-o", "r"}).exit_code, 2);
  std::ofstream(folder.path / "r/run.json") << "{\"tlab\": \"0.0.9\"}";
  EXPECT_EQ(tlab(folder.path, {"run", "other.toml", "-o", "r"}).exit_code, 0);
}

TEST_F(Sweep, MistakesAreNamed) {
  for (const auto& [more, told] : std::vector<std::pair<Arguments, std::string>>{
           {{"--point", "6"}, "--point 6: expected the number of a point, or two as in 0-9"},
           {{"--point", "5-4"}, "--point 5-4"},
           {{"--point", "0-6"}, "from 0 to 5"},
           {{"--point", "-1"}, "--point"},
           {{"--point", "one"}, "--point one"},
           {{"--point", "0", "--set", "run.cost=timed"}, "found cost = \"timed\""},
           {{"--jobs", "0"}, "--jobs"},
           {{"--set", "sweep.workers=[]"}, "at least one"},
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

// A disk that fills: no file may be longer than this.
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
  EXPECT_EQ(visible("r"), before);
  EXPECT_EQ(records("r").size(), 8u);
  const auto none = run_with_limit(folder.path, {"run", "e.toml", "-o", "s"}, 100);
  EXPECT_EQ(none.exit_code, 2);
  EXPECT_TRUE(contains(none.err, "s/points/")) << none.err;
  const auto resumed = run({"-o", "r"});
  EXPECT_TRUE(contains(resumed.out, "6 of 6 points were there")) << resumed.out;
}

// A key changes with what changes the result, and with nothing else.
TEST(ExperimentsPointKey, DependsOnWhatAPointDoes) {
  const double never = std::numeric_limits<double>::infinity();
  const auto key = [&](const std::string& text, double until_s = 1e300) {
    return make_keys(load(text), until_s).at(0);
  };
  const std::string base = "[image]\nwidth = 10\n";
  EXPECT_EQ(key(base), key("title = \"t\"\nquestion = \"q\"\n" + base +
                           "[let]\na = \"1\"\n[[check]]\nname = \"c\"\nof = \"rays\"\nwithin = 1\n"
                           "formula = \"1\"\n"));
  EXPECT_EQ(key(base), key("[sweep]\nwidth = [10]\n"));
  EXPECT_EQ(key(base, never), make_keys(load("[sweep]\nwidth = [7, 10]\n"), never).at(1));
  for (const char* more : {"height = 10\n", "[farm]\nseed = 2\n", "[model.cpu]\nclock = 20e6\n",
                           "[machine]\nmodel = \"t800-20\"\n", "[[stage]]\nmin_cell = 2\n",
                           "[network]\nworkers = 2\n"})
    EXPECT_NE(key(base), key(base + more)) << more;
  EXPECT_NE(key(base), key(base, 3.5));
}

TEST(ExperimentsPointKey, DependsOnWhatFilesHold) {
  const TemporaryFolder folder;
  const auto key = [&] {
    return make_keys(read_experiment("[network]\ntopology = \"net.dot\"\n", "e.toml",
                                     folder.path.string(), {}),
                     1)
        .at(0);
  };
  std::ofstream(folder.path / "net.dot") << "graph { a--b }";
  const auto first = key();
  EXPECT_EQ(key(), first);
  std::ofstream(folder.path / "net.dot") << "graph { a--b b--c }";
  EXPECT_NE(key(), first);
}

}  // namespace
}  // namespace experiments
