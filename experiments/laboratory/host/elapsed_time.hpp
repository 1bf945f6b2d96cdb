#pragma once
// Elapsed-time display for work of unknown duration.
#include <chrono>
#include <string>
#include <thread>

namespace laboratory {

/// While this object lives, shows "WHAT, 3 s" (host time) on standard error if that is a terminal.
/// The display begins after the delay `after`. It has its own thread, which receives no signals.
/// Processes forked while the object lives must call exec.
class ElapsedTime {
 public:
  explicit ElapsedTime(std::string what, std::chrono::milliseconds after = std::chrono::seconds(2));

 private:
  std::jthread thread_;
};

}  // namespace laboratory
