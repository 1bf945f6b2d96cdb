#pragma once
// Runs tasks in child processes: a simulation needs a process of its own (SimGrid's engine is a
// singleton), and so they run side by side.
#include <functional>
#include <stdexcept>
#include <string>

#include "experiments/laboratory/host/interrupt.hpp"

namespace laboratory {

/// Ends the program with a message and an exit code: 1 for a defect or a check that does not hold,
/// 2 for bad input or a host that lacks something, 3 for a simulated fault, 130 where the user
/// interrupted.
struct Failure : std::runtime_error {
  Failure(const std::string& what, int exit_code)
      : std::runtime_error(what), exit_code(exit_code) {}
  int exit_code;
};
inline constexpr int EXIT_DEFECT = 1, EXIT_INPUT = 2, EXIT_HOST = 2, EXIT_FAULT = 3;

/// The user interrupted the program (SIGINT, SIGTERM) before there were results.
struct Interrupted : Failure {
  Interrupted() : Failure(INTERRUPTED, EXIT_INTERRUPTED) {}
};

/// What a task does in its child process; its result travels back as text.
using Job = std::function<std::string(std::size_t index)>;

/// How a task ended: with a result, or, where its process was killed or had no memory, with the
/// reason in `died`.
struct JobEnd {
  std::size_t index = 0;
  std::string result, died;
};

/// Runs jobs 0 .. count-1, at most `parallel` at once, and calls `ended` for each in the order in
/// which they end. An exception of a job ends the others and is thrown as Failure; an exception
/// of `ended` ends the others too. When the user interrupts, running jobs are asked to end their
/// simulation (machine::request_stop) and no more are started. A second interrupt is thrown as
/// Interrupted.
void for_each_job(std::size_t count, std::size_t parallel, const Job& job,
                  const std::function<void(JobEnd)>& ended);

/// The exit code for an exception: that of a Failure, 1 for a broken invariant, 3 for a simulated
/// fault, else 2: bad input, or a host that lacks something.
int exit_code_of(const std::exception& error);

}  // namespace laboratory
