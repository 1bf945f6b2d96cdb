#pragma once
// A sign of life of work whose length nobody knows.
#include <chrono>
#include <string>
#include <thread>

namespace laboratory {

/// As long as it lives, and from `after` on, a terminal at standard error shows "WHAT, 3 s"; a pipe
/// shows nothing. Takes no signals. Nothing may be forked meanwhile that goes on without exec.
class Patience {
 public:
  explicit Patience(std::string what, std::chrono::milliseconds after = std::chrono::seconds(2));

 private:
  std::jthread thread_;
};

}  // namespace laboratory
