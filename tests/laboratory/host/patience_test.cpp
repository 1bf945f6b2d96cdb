// Signs of life on a terminal.
#include "experiments/laboratory/host/patience.hpp"

#include <gtest/gtest.h>
#include <pty.h>
#include <unistd.h>

namespace laboratory {
namespace {

// Standard error is a terminal while it lives.
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
  // Reads until a text has come.
  std::string read_until(const std::string& text) const {
    std::string found;
    char part[256];
    while (found.find(text) == found.npos) {
      const auto n = read(master_, part, sizeof part);
      if (n <= 0) break;
      found.append(part, static_cast<std::size_t>(n));
    }
    return found;
  }

 private:
  int stderr_, master_ = -1;
};

TEST(Patience, ATerminalShowsWhatTakesLong) {
  const Terminal terminal;
  const Patience patience("making\x1b[2J it", std::chrono::milliseconds(0));
  EXPECT_NE(terminal.read_until(" s").find("making\\x1b[2J it, 0 s"), std::string::npos);
}

TEST(Patience, APipeShowsNothing) {
  testing::internal::CaptureStderr();
  { const Patience patience("making", std::chrono::milliseconds(0)); }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace laboratory
