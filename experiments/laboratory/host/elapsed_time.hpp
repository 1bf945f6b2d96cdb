#pragma once
// Elapsed-time display for work of unknown duration.
#include <chrono>
#include <string>
#include <thread>

namespace laboratory {

/// While this object lives and standard error is a terminal, shows "WHAT, 3 s" there after the
/// delay `after`. The display has its own thread, which receives no signals. Processes forked
/// meanwhile must call exec.
class ElapsedTime {
 public:
  explicit ElapsedTime(std::string what, std::chrono::milliseconds after = std::chrono::seconds(2));

 private:
  std::jthread thread_;
};

}  // namespace laboratory
