#pragma once
// Runs tasks in child processes: a simulation needs a process of its own (SimGrid's engine is a
// singleton), and so they run side by side.
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

namespace laboratory {

// A task failed: its message, and the exit code that the program should end with.
struct JobFailed : std::runtime_error {
  JobFailed(const std::string& what, int exit_code)
      : std::runtime_error(what), exit_code(exit_code) {}
  int exit_code;
};

// The user interrupted the program (SIGINT, SIGTERM).
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted; nothing but points that were done is kept") {}
};

// What a task does, in the child; its result travels back as text.
using Job = std::function<std::string(std::size_t index)>;

// How a task ended: with its result, or its process came to nothing (killed, or no memory), and
// `died` says how.
struct JobEnd {
  std::size_t index = 0;
  std::string result, died;
};

// Runs jobs 0 .. count-1, at most `parallel` at once; `ended` is told of each in the order in which
// they end. An exception of a job ends the others and is thrown as JobFailed; what `ended` throws
// ends the others too.
// Where the user interrupts: those under way are asked to end their simulation
// (machine::request_stop), the others are not started. A second interrupt is thrown as Interrupted.
void for_each_job(std::size_t count, std::size_t parallel, const Job& job,
                  const std::function<void(JobEnd)>& ended);

// The same for few and small results, in their order; those of jobs that were not started are
// empty. A process that came to nothing is a failure as any other.
std::vector<std::string> run_jobs(std::size_t count, std::size_t parallel, const Job& job);

// Whether the user has interrupted since the last time that jobs were run.
bool was_interrupted();

// Results have been written, of what was measured until the user interrupted.
struct CutShort : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// Some check of an experiment does not hold; its results have been kept.
struct ChecksFailed : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The exit code for an exception: 1 for a broken invariant or a check that does not hold, 3 for a
// simulated fault, 130 where the user interrupted, a failed job's own, else 2: bad input, or a host
// that cannot do it.
int exit_code_of(const std::exception& error);

}  // namespace laboratory
