#pragma once
// Interrupts by the user: Ctrl-C, SIGINT or SIGTERM. A signal that was ignored at program start, as
// under nohup and in background jobs of scripts, stays ignored.

#include <array>
#include <csignal>
#include <iterator>
#include <thread>

namespace laboratory {

inline constexpr int ASKS_TO_END[] = {SIGINT, SIGTERM};
inline constexpr int EXIT_INTERRUPTED = 130;
inline constexpr const char* INTERRUPTED = "interrupted; only what was done is kept";

using Handlers = std::array<void (*)(int), std::size(ASKS_TO_END)>;

/// While this object lives, the signals end the program anywhere: it undoes half-done work
/// (base/early_end.hpp), prints INTERRUPTED on standard error and exits with EXIT_INTERRUPTED.
/// Exception: the first signal under an InterruptGuard is only counted. After its destruction the
/// signals have no effect. Made once, by the main thread.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

 private:
  std::thread waits_;
};

/// While it lives, these signals are counted from 0 and do not end the program.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  Handlers old_;
};

/// The number of interrupts since the construction of the last guard.
int count_interrupts();
inline bool was_interrupted() { return count_interrupts() != 0; }

}  // namespace laboratory
