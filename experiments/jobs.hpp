#pragma once
// Runs tasks in child processes: a simulation needs a process of its own (SimGrid's engine is a
// singleton), and so they run side by side.
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace experiments {

// A task failed: its message, and the exit code that the program should end with.
struct JobFailed : std::runtime_error {
  JobFailed(const std::string& what, int exit_code)
      : std::runtime_error(what), exit_code(exit_code) {}
  int exit_code;
};

// The user interrupted the program (SIGINT, SIGTERM).
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted; nothing was written") {}
};

// What a task does, in the child; its result travels back as text.
using Job = std::function<std::string(std::size_t index)>;

// Runs jobs 0 .. count-1, at most `parallel` at once, and returns their results in order. The first
// failure ends the others and is thrown as JobFailed; `done` is told after each.
std::vector<std::string> run_jobs(std::size_t count, std::size_t parallel, const Job& job,
                                  const std::function<void(std::size_t done)>& done = {});

// The exit code for an exception: 1 for a broken invariant, 3 for a simulated fault, 130 where the
// user interrupted, a failed job's own, else 2: bad input, or a host that cannot do it.
int exit_code_of(const std::exception& error);

}  // namespace experiments
