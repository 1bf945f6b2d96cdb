// The command in its own process.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "experiments/laboratory/command/commands.hpp"
#include "tests/laboratory/support/support.hpp"
#include "tests/support/places.hpp"

namespace laboratory {

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

/// Starts tlab with `folder` as its current folder, and `handler` for the signals that ask it to
/// end. Its output goes to the files .out and .err in that folder.
inline pid_t start_tlab(const std::filesystem::path& folder, std::vector<std::string> arguments,
                        void (*handler)(int) = SIG_DFL) {
  arguments.insert(arguments.begin(), "tlab");
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid != 0) return pid;
  std::vector<char*> argv;
  for (auto& a : arguments) argv.push_back(a.data());
  for (const int asked : {SIGINT, SIGTERM, SIGHUP}) std::signal(asked, handler);
  std::filesystem::current_path(folder);
  if (!freopen(".out", "w", stdout) || !freopen(".err", "w", stderr)) _exit(99);
  const int code = run_tlab(static_cast<int>(argv.size()), argv.data());
  std::fflush(nullptr);
  _exit(code);
}

/// Waits for the process that start_tlab() started in `folder`, and removes the files.
inline Outcome wait_for_tlab(const std::filesystem::path& folder, pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  const auto out = folder / ".out", err = folder / ".err";
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return outcome;
}

/// Runs a shell line in `folder` with $TLAB as the built program. Returns the exit code, as a shell
/// counts it.
inline int run_line(const std::filesystem::path& folder, const std::string& line) {
  const auto command =
      "cd '" + folder.string() + "' && export TLAB='" + ::test::in_build("tlab") + "' && " + line;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

inline Outcome tlab(const std::filesystem::path& folder, std::vector<std::string> arguments) {
  return wait_for_tlab(folder, start_tlab(folder, std::move(arguments)));
}

}  // namespace laboratory
