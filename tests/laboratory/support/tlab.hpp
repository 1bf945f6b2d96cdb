// Runs the command tlab in a process of its own.
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

/// Starts tlab with `folder` as its current folder. `handler` is the handler of the signals that
/// ask tlab to end. The output of tlab goes to the files .out and .err in the folder.
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

/// Waits for the end of the process that start_tlab() started in `folder`, and removes .out and
/// .err.
inline Outcome wait_for_tlab(const std::filesystem::path& folder, pid_t pid) {
  int status = 0;
  waitpid(pid, &status, 0);
  const auto out = folder / ".out", err = folder / ".err";
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return outcome;
}

/// Runs a line of shell commands in `folder`, with the built program as $TLAB. Returns the exit
/// code of the shell, or 128 + the number of the signal that ended the shell.
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
