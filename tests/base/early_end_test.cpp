#include "base/early_end.hpp"

#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <thread>

#include "base/host_program.hpp"
#include "base/partial_name.hpp"
#include "base/whole_file.hpp"
#include "tests/support/files.hpp"
#include "tests/support/isolated.hpp"
#include "tests/support/processes.hpp"

namespace base {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using Names = std::vector<std::string>;

bool becomes_gone(pid_t process) {
  for (int i = 0; i < 1000 && !test::is_gone(process); ++i) usleep(10'000);
  return test::is_gone(process);
}

TEST(EarlyEnd, UndoesTheLatestFirstAndNothingThatHasGone) {
  const auto done = test::isolated([] {
    std::string text;
    // never deleted, because the destructor would block after undo_all()
    new Undo([&] { text += "first"; });
    {
      const Undo gone([&] { text += "gone "; });
    }
    new Undo([] { throw std::runtime_error("cannot be undone"); });
    new Undo([&] { text += "second "; });
    undo_all();
    return text;
  });
  EXPECT_EQ(done, "second first");
}

// One thread ends the process while another is inside nested critical sections. After that, no
// thread can enter a section.
TEST(EarlyEnd, WaitsForSectionsAndLetsNoThreadIntoAnother) {
  const auto done = test::isolated([] {
    std::atomic<bool> is_inside = false, is_left = false, is_inside_again = false;
    std::thread([&] {
      {
        const Undivided section;
        is_inside = true;
        usleep(100'000);
        const Undivided nested;
        is_left = true;
      }
      const Undivided never;
      is_inside_again = true;
    }).detach();
    while (!is_inside) usleep(1000);
    undo_all();
    const bool waited = is_left;
    usleep(100'000);
    return std::string(waited ? "waited" : "") + (is_inside_again ? ", then inside" : "");
  });
  EXPECT_EQ(done, "waited");
}

TEST(EarlyEnd, AFileThatIsBeingWrittenLeavesNothing) {
  const TemporaryFolder folder;
  save_whole(folder.path / "a", "old");
  test::isolated([&] {
    std::atomic<bool> is_writing = false;
    std::thread([&] {
      save_whole(folder.path / "a", [&](std::ostream& out) {
        out << "new";
        is_writing = true;
        pause();
      });
    }).detach();
    while (!is_writing) usleep(1000);
    if (folder.names().size() != 2) throw std::runtime_error("expected a partial file");
    undo_all();
    return "";
  });
  EXPECT_EQ(folder.names(), Names{"a"});
  EXPECT_EQ(read_text(folder.path / "a"), "old");
}

// Starts a thread that runs a host program that only sleeps. Returns the process id of the program.
pid_t start_sleeper(const fs::path& folder) {
  const auto number = folder / "number";
  std::thread([=] {
    try {
      run_program({.name = "sh",
                   .arguments = {"-c", "echo $$ > \"$0.new\"; mv \"$0.new\" \"$0\"; exec sleep 600",
                                 number.string()},
                   .purpose = "sleep",
                   .remedy = "none"});
    } catch (const std::runtime_error&) {  // the sleeping program was killed
    }
  }).detach();
  while (!fs::exists(number)) usleep(1000);
  return static_cast<pid_t>(std::stol(read_text(number)));
}

TEST(EarlyEnd, ProgramsEndToo) {
  const TemporaryFolder folder;
  const auto sleeper = test::isolated([&] {
    const auto number = start_sleeper(folder.path);
    undo_all();
    return std::to_string(number) + (becomes_gone(number) ? "" : " lives");
  });
  EXPECT_EQ(sleeper.find("lives"), sleeper.npos);
}

TEST(EarlyEnd, ProgramsDoNotOutliveAKilledProcess) {
  const TemporaryFolder folder;
  EXPECT_THROW(test::isolated([&] {
                 start_sleeper(folder.path);
                 raise(SIGKILL);
                 return "";
               }),
               std::runtime_error);
  EXPECT_TRUE(becomes_gone(static_cast<pid_t>(std::stol(read_text(folder.path / "number")))));
}

TEST(PartialName, TellsWhoMadeIt) {
  const auto name = make_partial_name("a.b", "partial", 123);
  EXPECT_TRUE(name.starts_with(".a.b.partial-")) << name;
  EXPECT_EQ(find_maker(name, "partial"), 123);
  EXPECT_EQ(find_maker(name + "-7.png", "partial"), 123);
  EXPECT_EQ(find_maker(name, "old"), std::nullopt);
  EXPECT_EQ(find_maker(name + "x", "partial"), std::nullopt);
  EXPECT_EQ(find_maker(name.substr(1), "partial"), std::nullopt);
  EXPECT_EQ(find_maker(".a.partial-another-host-123", "partial"), std::nullopt);
  EXPECT_FALSE(is_dead(getpid()));
}

// The names of two hosts must not be confused. Without doubled hyphens, a name ending in
// "node-12-345" could belong to process 345 of host "node-12", or be file 345 of process 12 of host
// "node".
TEST(PartialName, IsNotTakenForAnotherHosts) {
  const std::string hosts[] = {"node", "node-12", "node--12",    "node-",
                               "12",   "a-12",    "node-12-345", ""};
  for (const auto& host : hosts) {
    const auto name = make_partial_name("r", "partial", 345, host);
    for (const auto& other : hosts)
      for (const auto* more : {"", "-7", "-7.png"}) {
        const auto expected = other == host ? std::optional<pid_t>(345) : std::nullopt;
        EXPECT_EQ(find_maker(name + more, "partial", other), expected)
            << name << more << " " << other;
      }
  }
}

}  // namespace
}  // namespace base
