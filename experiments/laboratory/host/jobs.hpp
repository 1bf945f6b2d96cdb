#pragma once
// Parallel execution of tasks in child processes. SimGrid's engine is a singleton, so each
// simulation needs its own process.
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

/// The work of a task in its child process. Its result is transferred as text.
using Job = std::function<std::string(std::size_t index)>;

/// The end of a task: `result`, or in `died` the reason why its process was killed or lacked
/// memory.
struct JobEnd {
  std::size_t index = 0;
  std::string result, died;
};

/// Runs jobs 0 .. count-1, at most `parallel` at once, and calls `ended` for each in order of
/// completion. If a job throws, all running jobs are killed and Failure is thrown. Running jobs are
/// also killed if `ended` throws. On an interrupt by the user, running jobs are asked to stop
/// (machine::request_stop), and no further ones start. A second interrupt throws Interrupted.
void for_each_job(std::size_t count, std::size_t parallel, const Job& job,
                  const std::function<void(JobEnd)>& ended);

/// The exit code for an exception: the code of a Failure, 1 for a broken invariant, 3 for a
/// simulated fault, else 2 (bad input or missing host resources).
int exit_code_of(const std::exception& error);

}  // namespace laboratory
