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
// failure ends the others and is thrown as JobFailed; `ended` is told after each how many have, and
// what it throws ends the others too.
// Where the user interrupts: those under way are asked to end their simulation
// (machine::request_stop), the others are not started and their results are empty. A second
// interrupt, or one when nothing has been measured, is thrown as Interrupted.
using Ended = std::function<void(std::size_t done, std::size_t index, const std::string& result)>;
std::vector<std::string> run_jobs(std::size_t count, std::size_t parallel, const Job& job,
                                  const Ended& ended = {});
// Whether that happened since run_jobs was last called.
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

}  // namespace experiments
