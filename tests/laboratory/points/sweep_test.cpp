// Sweeps in several parts: records of points, and runs that are resumed, merged and extended.
#include <fmt/format.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "tests/laboratory/support/sweep.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

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
  EXPECT_TRUE(contains(resumed.out, "2 of 6 points were already recorded")) << resumed.out;
  EXPECT_EQ(visible("resumed"), expected);

  fs::remove_all(folder.path / "resumed/plots");
  std::ofstream(folder.path / "resumed/report.html") << "old";
  const auto report = tlab(folder.path, {"report", "resumed"});
  EXPECT_EQ(report.exit_code, 0) << report.err;
  EXPECT_EQ(visible("resumed"), expected);
}

// The experiment's folder is found, whatever the current folder is.
TEST_F(Sweep, ItIsMergedFromAnyFolder) {
  write_file(folder.path / "s.nff",
             "v\nfrom 0 0 5\nat 0 0 0\nup 0 1 0\nangle 40\nhither 1\n"
             "resolution 8 8\nl 2 3 4\nf 1 1 1 0.5 0.5 9 0 1\ns 0 0 0 1\n");
  write_file(folder.path / "e.toml",
             "[image]\nwidth = 8\nheight = 8\n[scene]\nsource = \"s.nff\"\n[sweep]\n"
             "workers = [1, 2]\n");
  ASSERT_EQ(run({"-o", "r", "--point", "0-1"}).exit_code, 0);
  const auto origin = read_file(folder.path / "r/points/experiment.json");
  fs::create_directories(folder.path / "deep/er");
  for (const auto& [from, name] : {std::pair("deep/er", "../../r"), {"deep", "../r"}, {".", "r"}}) {
    const auto merged = tlab(folder.path / from, {"merge", name});
    EXPECT_EQ(merged.exit_code, 0) << from << merged.err;
    EXPECT_EQ(read_file(folder.path / "r/points/experiment.json"), origin) << from;
  }
  EXPECT_EQ(run({"-o", "r"}).exit_code, 0);
}

TEST_F(Sweep, ALargerOneRunsOnlyWhatIsNew) {
  ASSERT_EQ(run({"-o", "r"}).exit_code, 0);
  const auto before = visible("r");
  const auto larger = run({"-o", "r", "--set", "sweep.workers=[1, 2, 3, 4]"});
  EXPECT_TRUE(contains(larger.out, "6 of 8 points were already recorded")) << larger.out;
  const auto smaller = run({"-o", "r", "--set", "sweep.workers=[1, 4]"});
  EXPECT_TRUE(contains(smaller.out, "4 of 4 points were already recorded")) << smaller.out;
  EXPECT_TRUE(contains(run({"-o", "r"}).out, "6 of 6 points were already recorded"));
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
  write_file(files[1], read_file(files[2]));  // replaces a record by the record of another point
  auto changed = read_file(files[3]);
  ++changed[changed.size() / 2];
  write_file(files[3], changed);
  write_file(files[4], "");
  const auto again = run({"-o", "r"});
  EXPECT_EQ(again.exit_code, 0) << again.err;
  EXPECT_TRUE(contains(again.out, "2 of 6 points were already recorded")) << again.out;
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

TEST_F(Sweep, KilledAndResumedAtAnyMomentGivesTheSameBytes) {
  ASSERT_EQ(run({"-o", "once"}).exit_code, 0);
  const auto expected = visible("once");
  for (const std::size_t wanted : {1, 3, 5}) {
    const auto name = fmt::format("r{}", wanted);
    const pid_t pid = start_tlab(folder.path, {"run", "e.toml", "-o", name, "--jobs", "1"});
    int status = 0;
    for (int i = 0; i < 30'000 && records(name).size() < wanted; ++i) usleep(1000);
    kill(pid, SIGKILL);
    waitpid(pid, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status)) << "it ended by itself: " << status;
    EXPECT_GE(records(name).size(), wanted);
    const auto resumed = run({"-o", name});
    EXPECT_EQ(resumed.exit_code, 0) << resumed.err;
    EXPECT_FALSE(contains(resumed.err, "damaged")) << resumed.err;
    EXPECT_EQ(visible(name), expected) << wanted;
  }
  EXPECT_EQ(folder.names(), (Arguments{"e.toml", "once", "r1", "r3", "r5"}));
}

TEST_F(Sweep, SeveralProcessesShareAFolder) {
  std::vector<pid_t> children;
  for (const char* point : {"0-2", "1-4", "5", "3-5"})
    children.push_back(
        start_tlab(folder.path, {"run", "e.toml", "-o", "r", "--point", point, "--jobs", "1"}));
  for (const pid_t child : children) {
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  EXPECT_EQ(tlab(folder.path, {"merge", "r"}).exit_code, 0);
  ASSERT_EQ(run({"-o", "once"}).exit_code, 0);
  EXPECT_EQ(visible("r"), visible("once"));
}

}  // namespace
}  // namespace laboratory
