#pragma once
// A progress bar with an estimate on a terminal; nothing in a pipe.
#include <chrono>
#include <cstddef>
#include <string>

namespace experiments {

class Progress {
 public:
  // Drawn on standard error if that is a terminal.
  explicit Progress(std::string what);
  ~Progress();
  void show(std::size_t done, std::size_t total);

 private:
  std::string what_;
  bool terminal_;
  std::chrono::steady_clock::time_point start_, shown_{};
};

}  // namespace experiments
