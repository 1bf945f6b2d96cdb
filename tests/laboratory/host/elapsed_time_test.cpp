// The display of elapsed time on a terminal.
#include "experiments/laboratory/host/elapsed_time.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

#include "experiments/laboratory/host/progress.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "tests/support/isolated.hpp"

namespace laboratory {
namespace {

// Makes standard error a terminal while the object lives.
class Terminal {
 public:
  Terminal() : stderr_(dup(STDERR_FILENO)) {
    int slave = -1;
    EXPECT_EQ(openpty(&master_, &slave, nullptr, nullptr, nullptr), 0);
    dup2(slave, STDERR_FILENO);
    close(slave);
  }
  ~Terminal() {
    dup2(stderr_, STDERR_FILENO);
    close(stderr_);
    close(master_);
  }
  // Reads from the terminal until a text has appeared.
  std::string read_until(const std::string& text) const {
    std::string found;
    char part[256];
    while (found.find(text) == found.npos) {
      const auto n = ::read(master_, part, sizeof part);
      if (n <= 0) break;
      found.append(part, static_cast<std::size_t>(n));
    }
    return found;
  }

 private:
  int stderr_, master_ = -1;
};

TEST(ElapsedTime, ATerminalShowsWhatTakesLong) {
  const Terminal terminal;
  const ElapsedTime elapsed_time("making\x1b[2J it", std::chrono::milliseconds(0));
  const auto shown = terminal.read_until(" s");
  EXPECT_NE(shown.find("making\\x1b[2J it, "), std::string::npos) << shown;
}

TEST(Streams, ALineOnATerminalTakesThePlaceOfAProgressBar) {
  const Terminal terminal;
  setenv("NO_COLOR", "1", 1);
  Progress bar("points");
  bar.show(3, 9);
  complain("interrupted");
  unsetenv("NO_COLOR");
  const auto shown = terminal.read_until("interrupted");
  EXPECT_NE(shown.find(" 3/9"), std::string::npos) << shown;
  EXPECT_NE(shown.find("\r\x1b[Ktlab: interrupted"), std::string::npos) << shown;
}

// An earlier write has failed. Its error code is lost, and the stream has nothing more to write.
TEST(Streams, AnEarlierErrorOfStandardOutputIsTold) {
  if (access("/dev/full", W_OK) != 0) GTEST_SKIP() << "no /dev/full";
  EXPECT_EQ(test::isolated([]() -> std::string {
              std::FILE* const full = std::fopen("/dev/full", "w");
              std::setvbuf(full, nullptr, _IONBF, 0);
              stdout = full;
              std::fputs("lost", stdout);
              try {
                flush_output();
                return "all is written";
              } catch (const std::system_error& error) {
                return error.what();
              }
            }),
            "cannot write standard output: Input/output error");
}

TEST(Streams, ALineInAPipeIsNothingElse) {
  testing::internal::CaptureStderr();
  complain("interrupted");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "tlab: interrupted\n");
}

TEST(ElapsedTime, APipeShowsNothing) {
  testing::internal::CaptureStderr();
  { const ElapsedTime elapsed_time("making", std::chrono::milliseconds(0)); }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace laboratory
