#include "experiments/laboratory/host/results_folder.hpp"
#include "base/whole_file.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <functional>
#include <system_error>
#include <thread>

#include "base/early_end.hpp"
#include "base/errors.hpp"
#include "base/partial_name.hpp"
#include "tests/laboratory/support/support.hpp"
#include "tests/support/isolated.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;
using Names = std::vector<std::string>;

pid_t dead_process() {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  return child;
}

// The beginning of the name of a process's hidden folder: ".out.partial-HOST-" for "out.partial".
std::string hidden(const std::string& what) {
  const auto dot = what.find('.');
  auto name = base::make_partial_name(what.substr(0, dot), what.substr(dot + 1), 0);
  name.pop_back();
  return name;
}

TEST(ExperimentsResultsFolder, ReadOnlyFolder) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write anywhere";
  const TemporaryFolder folder;
  fs::permissions(folder.path, fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(ResultsFolder(folder.path / "out"), std::system_error);
  fs::permissions(folder.path, fs::perms::owner_all);
}

TEST(ExperimentsResultsFolder, CommitPutsItInPlace) {
  const TemporaryFolder folder;
  const auto out = folder.path / "deep" / "out";
  ResultsFolder results(out);
  write_file(results.working() / "run.json", "{}");
  EXPECT_FALSE(fs::exists(out));
  results.commit();
  EXPECT_EQ(read_file(out / "run.json"), "{}");
  EXPECT_FALSE(fs::exists(results.working()));
  EXPECT_THROW(results.commit(), std::logic_error);
}

TEST(ExperimentsResultsFolder, CommitReplacesEarlierResultsAsAWhole) {
  const TemporaryFolder folder;
  const auto out = folder.path / "out";
  fs::create_directories(out / "plots");
  write_file(out / "run.json", "old");
  write_file(out / "plots" / "old.svg", "old");
  ResultsFolder results(out / "");
  write_file(results.working() / "run.json", "new");
  EXPECT_EQ(read_file(out / "run.json"), "old");
  results.commit();
  EXPECT_EQ(read_file(out / "run.json"), "new");
  EXPECT_FALSE(fs::exists(out / "plots"));
  EXPECT_EQ(folder.names(), Names{"out"});
}

TEST(ExperimentsResultsFolder, WithoutCommitNothingChanges) {
  const TemporaryFolder folder;
  const auto out = folder.path / "out";
  { write_file(ResultsFolder(out).working() / "run.json", "{}"); }
  EXPECT_TRUE(folder.names().empty());
  fs::create_directory(out);
  write_file(out / "run.json", "old");
  try {
    ResultsFolder results(out);
    write_file(results.working() / "run.json", "new");
    throw std::runtime_error("the simulation deadlocked");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(folder.names(), Names{"out"});
  EXPECT_EQ(read_file(out / "run.json"), "old");
}

TEST(ExperimentsResultsFolder, RefusesToDestroyWhatIsNotOurs) {
  const TemporaryFolder folder;
  const auto refusal = [](const fs::path& path) {
    return message_of<base::BadInput>([&] { ResultsFolder{path}; });
  };
  const auto out = folder.path / "out";
  write_file(out, "a file");
  EXPECT_TRUE(refusal(out).starts_with(out.string() + ": is not a folder")) << refusal(out);
  fs::remove(out);
  fs::create_directory(out);
  EXPECT_EQ(refusal(out), "") << "an empty folder may be used";
  write_file(out / "thesis.tex", "years of work");
  EXPECT_TRUE(refusal(out).starts_with(out.string() + ": holds files that are not results"));
  EXPECT_NE(refusal(".").find("holds the current folder"), std::string::npos) << refusal(".");
  EXPECT_NE(refusal("/").find("holds the current folder"), std::string::npos) << refusal("/");
  EXPECT_NE(refusal(""), "");
  EXPECT_EQ(folder.names(), Names{"out"});
}

TEST(ExperimentsResultsFolder, WhatFileManagersLeaveIsNoObstacle) {
  const TemporaryFolder folder;
  const auto out = folder.path / "out";
  fs::create_directories(out / "points" / "0123");
  for (const auto* place : {"", "points", "points/0123"})
    for (const auto* name : {".DS_Store", "Thumbs.db", "desktop.ini", ".directory"})
      write_file(out / place / name, "x");
  EXPECT_NO_THROW(check_results_folder(out));
  write_file(out / "points" / ".DS_Store_of_mine", "x");
  EXPECT_THROW(check_results_folder(out), base::BadInput);
}

TEST(ExperimentsResultsFolder, FoldersWithNamesOfFileManagersAreNotOurs) {
  for (const auto* place : {"", "points", "points/0123", "plots"})
    for (const auto* name : {".DS_Store", "Thumbs.db", "desktop.ini", ".directory"})
      for (const bool is_link : {false, true}) {
        const TemporaryFolder folder;
        const auto out = folder.path / "out", inside = out / place / name;
        fs::create_directories(out / "points");
        fs::create_directories(is_link ? folder.path / "mine" : inside);
        write_file((is_link ? folder.path / "mine" : inside) / "thesis.tex", "years of work");
        fs::create_directories(inside.parent_path());
        if (is_link) fs::create_directory_symlink(folder.path / "mine", inside);
        EXPECT_THROW(check_results_folder(out), base::BadInput) << inside << is_link;
      }
}

TEST(ExperimentsResultsFolder, LooksAgainBeforeItCommits) {
  const TemporaryFolder folder;
  const auto out = folder.path / "out";
  {
    ResultsFolder results(out);
    fs::create_directory(out);
    write_file(out / "thesis.tex", "years of work");
    EXPECT_THROW(results.commit(), base::BadInput);
  }
  EXPECT_EQ(read_file(out / "thesis.tex"), "years of work");
  EXPECT_EQ(folder.names(), Names{"out"});
}

// Another process stores its results after the first check of older results, and before the
// exchange of the folders.
TEST(ExperimentsResultsFolder, LooksOnceMoreAtWhatItHasReplaced) {
  const TemporaryFolder folder;
  const auto out = folder.path / "out";
  for (const bool was_there : {false, true}) {
    if (was_there) write_file(out / "run.json", "old");
    ResultsFolder results(out);
    write_file(results.working() / "run.json", "new");
    int looks = 0;
    const auto told = message_of<base::BadInput>([&] {
      results.commit([&](const fs::path& replaced) {
        if (++looks == 1) {  // at this moment, another process writes its results
          fs::create_directories(out);
          write_file(out / "run.json", "another's");
        } else if (read_file(replaced / "run.json") == "another's") {
          base::refuse(replaced.string(), "another's");
        }
      });
    });
    EXPECT_EQ(told, out.string() + ": another's");
    EXPECT_EQ(read_file(out / "run.json"), "another's");
  }
  EXPECT_EQ(folder.names(), Names{"out"});
}

// A check of older results that fails when it is called for the second time, after the exchange.
class CountedCheck {
 public:
  explicit CountedCheck(std::function<void()> before_failing = [] {})
      : before_failing_(std::move(before_failing)) {}
  void operator()(const fs::path&) {
    if (++looks_ != 2) return;
    before_failing_();
    throw std::runtime_error("the host has no more memory");
  }

 private:
  std::function<void()> before_failing_;
  int looks_ = 0;
};

TEST(ExperimentsResultsFolder, AnyErrorAfterTheExchangeBringsTheOlderBack) {
  const TemporaryFolder folder;
  const auto out = folder.path / "out";
  fs::create_directories(out / "points/0123");
  write_file(out / "points/0123/a.json", "old");
  {
    ResultsFolder results(out);
    write_file(results.working() / "run.json", "new");
    EXPECT_EQ(message_of<std::runtime_error>([&] { results.commit(CountedCheck()); }),
              "the host has no more memory");
  }
  EXPECT_EQ(read_file(out / "points/0123/a.json"), "old");
  EXPECT_FALSE(fs::exists(out / "run.json"));
  EXPECT_EQ(folder.names(), Names{"out"});
}

TEST(ExperimentsResultsFolder, OlderRecordsThatCannotBePutBackAreKept) {
  const TemporaryFolder folder;
  const auto out = folder.path / "out";
  fs::create_directories(out / "points/0123");
  write_file(out / "points/0123/a.json", "old");
  {
    ResultsFolder results(out);
    const CountedCheck look([&] { fs::rename(out, folder.path / "elsewhere"); });
    const auto told = message_of<std::system_error>([&] { results.commit(look); });
    EXPECT_TRUE(told.starts_with("the host has no more memory; it cannot be put back to ")) << told;
  }
  { ResultsFolder results(out); }
  EXPECT_EQ(read_file(out / "points/0123/a.json"), "old");
  EXPECT_EQ(folder.names(), (Names{"elsewhere", "out"}));
}

// A symbolic link to itself stands for a record that cannot be copied because the disk is full.
TEST(ExperimentsResultsFolder, OlderRecordsThatCannotBeCarriedOverAreKept) {
  const TemporaryFolder folder;
  const auto out = folder.path / "out", points = fs::path("points/0123");
  fs::create_directories(out / points);
  for (const auto* record : {"a.json", "b.json"}) write_file(out / points / record, "old");
  {
    ResultsFolder results(out);
    fs::create_directories(results.working() / points);
    for (const auto* record : {"a.json", "b.json"})
      fs::create_symlink(record, results.working() / points / record);
    EXPECT_THROW(results.commit(), fs::filesystem_error);
  }
  for (const auto* record : {"a.json", "b.json"}) fs::remove(out / points / record);
  { ResultsFolder results(out); }
  for (const auto* record : {"a.json", "b.json"})
    EXPECT_EQ(read_file(out / points / record), "old");
  EXPECT_EQ(folder.names(), Names{"out"});
}

TEST(ExperimentsResultsFolder, FollowsALinkToEarlierResults) {
  const TemporaryFolder folder;
  fs::create_directory(folder.path / "out");
  write_file(folder.path / "out" / "run.json", "old");
  fs::create_directory_symlink("out", folder.path / "latest");
  ResultsFolder results(folder.path / "latest");
  write_file(results.working() / "run.json", "new");
  results.commit();
  EXPECT_TRUE(fs::is_symlink(folder.path / "latest"));
  EXPECT_EQ(read_file(folder.path / "out" / "run.json"), "new");
  EXPECT_EQ(folder.names(), (Names{"latest", "out"}));
}

TEST(ExperimentsResultsFolder, RemovesWhatDeadProcessesLeft) {
  const TemporaryFolder folder;
  const auto dead = std::to_string(dead_process()), alive = std::to_string(getppid());
  const auto partial = hidden("out.partial");
  const Names kept{partial + alive, partial + dead + "x", hidden("other.partial") + dead,
                   ".out.partial-of-another-host-" + dead};
  fs::create_directories(folder.path / (partial + dead) / "plots");
  for (const auto& name : kept) fs::create_directories(folder.path / name / "plots");
  // dead processes leave folders with such names, but no files
  const auto dead_too = hidden("out.old") + dead;
  write_file(folder.path / dead_too, "x");
  { ResultsFolder results(folder.path / "out"); }
  Names expected = kept;
  expected.push_back(dead_too);
  std::ranges::sort(expected);
  EXPECT_EQ(folder.names(), expected);
}

// Records of points are kept, whatever happens to the folder that contains them.
TEST(ExperimentsResultsFolder, RecordsAreKept) {
  const TemporaryFolder folder;
  const auto out = folder.path / "out", working = folder.path / hidden("out.partial");
  const auto dead = std::to_string(dead_process());
  const auto put = [](const fs::path& root, const char* record) {
    fs::create_directories(root / "points/0123");
    write_file(root / "points/0123" / record, record);
  };
  const auto has = [&](const char* record) {
    return fs::exists(out / "points/0123" / record) &&
           read_file(out / "points/0123" / record) == record;
  };
  // One process was killed after it had put its results in place. Another process was killed before
  // it had done so.
  put(working.string() + dead, "a.json");
  fs::create_directories(working.string() + dead + "/points/lone");
  write_file(working.string() + dead + "/points/lone/x.json", "x");
  put(out, "b.json");
  {
    ResultsFolder results(out);
    EXPECT_TRUE(has("a.json") && has("b.json"));
    EXPECT_FALSE(fs::exists(out / "points/lone"));
    write_file(results.working() / "run.json", "{}");
    put(results.working(), "b.json");
    put(out, "late.json");  // as another process may do in the meantime
    results.commit();
  }
  EXPECT_TRUE(has("b.json") && has("late.json"));
  EXPECT_EQ(folder.names(), Names{"out"});
  // A folder of points without run.json is removed with the older results.
  put(out, "old.json");
  ResultsFolder(out).commit();
  EXPECT_FALSE(fs::exists(out / "points"));
}

TEST(ExperimentsResultsFolder, LeavesNoParentsWhereItCannotBeMade) {
  const TemporaryFolder folder;
  const std::string name(250, 'x');  // valid, but the name of the hidden folder would be too long
  EXPECT_THROW(ResultsFolder(folder.path / "a/b" / name), std::system_error);
  EXPECT_EQ(folder.names(), Names{});
}

TEST(ExperimentsResultsFolder, ANameThatIsTooLongIsRefused) {
  const std::string name(300, 'x');
  EXPECT_EQ(message_of<base::BadInput>([&] { check_results_folder(name); }),
            name + ": File name too long");
}

TEST(ExperimentsResultsFolder, ErrorsOfTheHostNameTheUsersPath) {
  const TemporaryFolder folder;
  const ResultsFolder results(folder.path / "out");
  const auto fill = [&](const std::string& name) {
    return message_of<std::system_error>(
        [&] { results.fill([&] { base::save_whole(results.working() / name, "{}"); }); });
  };
  EXPECT_EQ(fill("run.json"), "");
  EXPECT_EQ(fill("missing/run.json"), (folder.path / "out/missing/run.json").string() +
                                          ": cannot be written: No such file or directory");
  EXPECT_EQ(message_of<std::system_error>(
                [&] { results.fill([] { base::save_whole("/dev/full", "{}"); }); }),
            "/dev/full: cannot be written: No space left on device");
}

// If the file system has no atomic exchange, a crash may leave the older results under a hidden
// name.
TEST(ExperimentsResultsFolder, FindsOlderResultsThatWereMovedAside) {
  const TemporaryFolder folder;
  const auto aside = folder.path / (hidden("out.old") + std::to_string(dead_process()));
  fs::create_directory(aside);
  write_file(aside / "run.json", "old");
  { ResultsFolder results(folder.path / "out"); }
  EXPECT_EQ(read_file(folder.path / "out/run.json"), "old");
  EXPECT_EQ(folder.names(), Names{"out"});
}

// A signal arrives while a thread is still writing a drawing.
TEST(ExperimentsResultsFolder, IsRemovedWhileSomebodyWritesThere) {
  for (int time = 0; time < 20; ++time) {
    const TemporaryFolder folder;
    test::run_isolated([&] {
      // Neither object is ever destroyed, because leaving a critical section would wait for the end
      // of the program.
      const auto* results = new ResultsFolder(folder.path / "out");
      new std::thread([from = results->working() / "new", to = results->working() / "renamed"] {
        for (int i = 0; i < 2000; ++i) {
          std::ofstream(from) << i;
          std::rename(from.c_str(), to.c_str());
        }
      });
      usleep(1000);
      base::undo_all();
    });
    EXPECT_TRUE(fs::is_empty(folder.path)) << "time " << time;
  }
}

TEST(ExperimentsResultsFolder, SurvivesAKilledRun) {
  const TemporaryFolder folder;
  const pid_t child = fork();
  if (child == 0) {
    ResultsFolder results(folder.path / "out");
    base::save_whole(results.working() / "run.json", "{}");
    _exit(9);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 9);
  EXPECT_EQ(folder.names().size(), 1u);
  ResultsFolder(folder.path / "out").commit();
  EXPECT_EQ(folder.names(), Names{"out"});
}

}  // namespace
}  // namespace laboratory
