#pragma once
// Runs tasks in parallel child processes: each simulation needs its own process, since SimGrid's
// engine is a singleton.
#include <functional>
#include <stdexcept>
#include <string>

#include "experiments/laboratory/host/interrupt.hpp"

namespace laboratory {

/// Ends the program with a message and an exit code: 1 for a defect or a failed check, 2 for bad
/// input or missing host resources, 3 for a simulated fault, 130 for an interrupt by the user.
struct Failure : std::runtime_error {
  Failure(const std::string& what, int exit_code)
      : std::runtime_error(what), exit_code(exit_code) {}
  int exit_code;
};
inline constexpr int EXIT_DEFECT = 1, EXIT_INPUT = 2, EXIT_HOST = 2, EXIT_FAULT = 3;

/// The user interrupted the program (SIGINT, SIGTERM) before it had results.
struct Interrupted : Failure {
  Interrupted() : Failure(INTERRUPTED, EXIT_INTERRUPTED) {}
};

/// The work of a task in its child process; its result returns as text.
using Job = std::function<std::string(std::size_t index)>;

/// The end of a task: `result`, or the reason in `died` if its process was killed or had no memory.
struct JobEnd {
  std::size_t index = 0;
  std::string result, died;
};

/// Runs jobs 0 .. count-1, at most `parallel` at once, and calls `ended` for each in order of
/// completion. An exception of a job ends the others and is thrown as Failure; an exception of
/// `ended` ends the others too. On an interrupt by the user, running jobs receive a request to end
/// their simulation (machine::request_stop), and no others start. A second interrupt is thrown as
/// Interrupted.
void for_each_job(std::size_t count, std::size_t parallel, const Job& job,
                  const std::function<void(JobEnd)>& ended);

/// The exit code for an exception: that of a Failure, 1 for a broken invariant, 3 for a simulated
/// fault, else 2 (bad input, or missing host resources).
int exit_code_of(const std::exception& error);

}  // namespace laboratory
