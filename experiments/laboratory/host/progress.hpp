#pragma once
// A progress bar with an estimate on a terminal; nothing in a pipe.
#include <chrono>
#include <cstddef>
#include <string>

namespace laboratory {

class Progress {
 public:
  /// Draws on standard error if that is a terminal. The first `there` of the items to be done took
  /// no time.
  explicit Progress(std::string what, std::size_t there = 0);
  ~Progress();
  void show(std::size_t done, std::size_t total);
  /// Prints a line above the bar, on any standard error.
  void say(const std::string& line);

 private:
  std::string what_;
  std::size_t there_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_, shown_{};
};

}  // namespace laboratory
