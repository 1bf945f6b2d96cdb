#pragma once
// What the user asks for with Ctrl-C, SIGINT or SIGTERM.

#include <csignal>
#include <iterator>

namespace laboratory {

inline constexpr int ASKS_TO_END[] = {SIGINT, SIGTERM};

/// While it lives, these signals are counted, from 0, instead of ending the program.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  void (*old_[std::size(ASKS_TO_END)])(int);
};

/// How often the user has interrupted since the last guard was made.
int count_interrupts();
inline bool was_interrupted() { return count_interrupts() != 0; }

}  // namespace laboratory
