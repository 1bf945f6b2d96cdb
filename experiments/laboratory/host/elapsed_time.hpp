#pragma once
// Display of elapsed time for work of unknown duration.
#include <chrono>
#include <string>
#include <thread>

namespace laboratory {

/// While it lives, shows "WHAT, 3 s" on standard error from `after` on, if that is a terminal. Its
/// thread receives no signals. Meanwhile, forked processes must call exec.
class ElapsedTime {
 public:
  explicit ElapsedTime(std::string what, std::chrono::milliseconds after = std::chrono::seconds(2));

 private:
  std::jthread thread_;
};

}  // namespace laboratory
