#pragma once
// Progress bar with an estimate of the remaining time, on terminals only, and a host clock.
#include <chrono>
#include <cstddef>
#include <string>
#include <utility>

namespace laboratory {

/// A stopwatch in host time.
class Clock {
 public:
  /// Seconds since the last lap, or since construction.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    return std::chrono::duration<double>(now - std::exchange(last_, now)).count();
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Prints on standard error how long `count` frames of an option will take, if that is 20 s or
/// more. Throws BadInput for more than 3 minutes unless the user has confirmed it with --yes.
void announce_cost(const std::string& option, std::size_t count, double seconds_each,
                   bool is_confirmed);

class Progress {
 public:
  /// Draws on standard error if that is a terminal. The first `there` items were done before the
  /// start and do not count for the estimate of time.
  explicit Progress(std::string what, std::size_t there = 0);
  ~Progress();
  void show(std::size_t done, std::size_t total);
  /// Prints a line above the bar, also if standard error is not a terminal.
  void say(const std::string& line);

 private:
  std::string what_;
  std::size_t there_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_, shown_{};
};

}  // namespace laboratory
