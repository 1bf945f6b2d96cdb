#pragma once
// Parallel execution of tasks, each in a child process. SimGrid's engine is a singleton, so each
// simulation needs a process of its own.
#include <functional>
#include <stdexcept>
#include <string>

#include "base/errors.hpp"
#include "experiments/laboratory/host/interrupt.hpp"

namespace laboratory {

/// Error that ends the program with a message and an exit code: 1 for a defect or a failed check, 2
/// for bad input or missing host resources, 3 for a simulated fault, 130 for an interrupt by the
/// user.
struct Failure : std::runtime_error {
  Failure(const std::string& what, int exit_code)
      : std::runtime_error(base::show_zeros(what)), exit_code(exit_code) {}
  int exit_code;
};
inline constexpr int EXIT_DEFECT = 1, EXIT_INPUT = 2, EXIT_HOST = 2, EXIT_FAULT = 3;

/// The user interrupted the program (SIGINT, SIGTERM, SIGHUP) before it had results.
struct Interrupted : Failure {
  Interrupted() : Failure(INTERRUPTED, EXIT_INTERRUPTED) {}
};

/// The work of task `index`, executed in a child process. The result is sent to the parent as text.
using Job = std::function<std::string(std::size_t index)>;

/// The end of a task: its result, or in `died` the reason why its process was killed or ran out of
/// memory.
struct JobEnd {
  std::size_t index = 0;
  std::string result, died;
};

/// Runs jobs 0 .. count-1, at most `parallel` at once, and calls `ended` for each in order of
/// completion. If a job throws, kills all running jobs and throws Failure. Kills them also if
/// `ended` throws. If the user interrupts, asks the running jobs to stop (machine::request_stop)
/// and starts no further ones. A second interrupt throws Interrupted.
void for_each_job(std::size_t count, std::size_t parallel, const Job& job,
                  const std::function<void(JobEnd)>& ended);

/// The exit code for an exception: the code of a Failure, 1 for a broken invariant, 3 for a
/// simulated fault, else 2 (bad input or missing host resources).
int exit_code_of(const std::exception& error);

}  // namespace laboratory
