#include "experiments/laboratory/host/pager.hpp"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <memory>

namespace laboratory {
namespace {

// Gives a text to a command's input; false where there is no such command.
bool pipe_to(const std::string& command, const std::string& text) {
  const auto before = std::signal(SIGPIPE, SIG_IGN);  // the reader may have read enough
  std::FILE* pager = popen(command.c_str(), "w");
  const bool is_open = pager != nullptr;
  if (is_open) std::fwrite(text.data(), 1, text.size(), pager);
  constexpr int NOT_FOUND = 127;
  const int status = is_open ? pclose(pager) : -1;
  std::signal(SIGPIPE, before);
  return is_open && !(WIFEXITED(status) && WEXITSTATUS(status) == NOT_FOUND);
}

}  // namespace

void print_paged(const std::string& text) {
  if (isatty(STDOUT_FILENO)) {
    std::fflush(stdout);
    const char* given = std::getenv("PAGER");
    setenv("LESS", "FRX", 0);  // ends at once where all fits, and leaves the text on the screen
    if (pipe_to(given && *given ? given : "less", text)) return;
  }
  fmt::print("{}", text);
}

}  // namespace laboratory
