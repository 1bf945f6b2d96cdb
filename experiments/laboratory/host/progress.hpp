#pragma once
// Progress bar with an estimate of the remaining time, shown on terminals only, and a stopwatch.
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>

namespace laboratory {

/// A stopwatch that measures real time of the host.
class Clock {
 public:
  /// Seconds since the previous call, or since construction.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Prints on standard error how long drawing `count` frames for an option will take, if that is 20
/// s or more. Throws BadInput if it is more than 3 minutes and the user has not given --yes.
void announce_cost(const std::string& option, std::size_t count, double seconds_each,
                   bool is_confirmed);

class Progress {
 public:
  /// Draws on standard error if that is a terminal that obeys escape sequences. `there` items were
  /// done before the start. They count as done, but not in the estimate of the remaining time.
  explicit Progress(std::string what, std::size_t there = 0);
  ~Progress();
  void show(std::size_t done, std::size_t total);
  /// Prints a line above the bar. Prints it even if standard error is not a terminal.
  void say(const std::string& line);

 private:
  std::string what_;
  std::size_t there_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_, shown_{};
};

}  // namespace laboratory
