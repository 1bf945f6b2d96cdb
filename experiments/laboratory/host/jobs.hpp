#pragma once
// Runs tasks in child processes: a simulation needs a process of its own (SimGrid's engine is a
// singleton), and so they run side by side.
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace laboratory {

/// A task failed: its message, and the exit code that the program should end with.
struct JobFailed : std::runtime_error {
  JobFailed(const std::string& what, int exit_code)
      : std::runtime_error(what), exit_code(exit_code) {}
  int exit_code;
};

/// The user interrupted the program (SIGINT, SIGTERM).
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted; nothing but points that were done is kept") {}
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
/// which they end. An exception of a job ends the others and is thrown as JobFailed; an exception
/// of `ended` ends the others too. When the user interrupts, running jobs are asked to end their
/// simulation (machine::request_stop) and no more are started. A second interrupt is thrown as
/// Interrupted.
void for_each_job(std::size_t count, std::size_t parallel, const Job& job,
                  const std::function<void(JobEnd)>& ended);

/// Runs jobs whose results are few and small, and returns these in order; results of jobs that were
/// not started are empty. A process that dies is a failure like any other.
std::vector<std::string> run_jobs(std::size_t count, std::size_t parallel, const Job& job);

/// Whether the user has interrupted since the last time that jobs were run.
bool was_interrupted();

/// The user interrupted, and results have been written of what was measured until then.
struct CutShort : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Some check of an experiment does not hold; its results have been kept.
struct ChecksFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The exit code for an exception: 1 for a broken invariant or a check that does not hold, 3 for a
/// simulated fault, 130 where the user interrupted, a failed job's own code, else 2: bad input, or
/// a host that lacks something.
int exit_code_of(const std::exception& error);

}  // namespace laboratory
