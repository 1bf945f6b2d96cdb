// The command in a process of its own.
#pragma once

#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <string>
#include <vector>

#include "experiments/laboratory/command/commands.hpp"
#include "tests/laboratory/support/support.hpp"

namespace laboratory {

struct Outcome {
  int exit_code = -1;
  std::string out, err;
};

// Runs tlab with `folder` as its current folder.
inline Outcome tlab(const std::filesystem::path& folder, std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "tlab");
  const std::filesystem::path out = folder / ".out", err = folder / ".err";
  std::fflush(nullptr);
  const pid_t pid = fork();
  if (pid == 0) {
    std::vector<char*> argv;
    for (auto& a : arguments) argv.push_back(a.data());
    if (!freopen(out.c_str(), "w", stdout) || !freopen(err.c_str(), "w", stderr)) _exit(99);
    std::filesystem::current_path(folder);
    const int code = run_tlab(static_cast<int>(argv.size()), argv.data());
    std::fflush(nullptr);
    _exit(code);
  }
  int status = 0;
  waitpid(pid, &status, 0);
  Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(out), read_file(err)};
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return outcome;
}

}  // namespace laboratory
