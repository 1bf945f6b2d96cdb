#pragma once
// Handling of interrupts by the user: Ctrl-C, the end of the terminal, SIGINT, SIGTERM and SIGHUP.
// Signals ignored at program start, as under nohup or in background jobs of scripts, stay ignored.

#include <array>
#include <csignal>
#include <iterator>
#include <thread>

namespace laboratory {

inline constexpr int ASKS_TO_END[] = {SIGINT, SIGTERM, SIGHUP};
inline constexpr int EXIT_INTERRUPTED = 130;
inline constexpr const char* INTERRUPTED = "interrupted; only completed work is kept";

using Handlers = std::array<struct sigaction, std::size(ASKS_TO_END)>;

/// While this object lives, an interrupt ends the program at once: the program undoes partial work
/// (base/early_end.hpp), prints INTERRUPTED on standard error and exits with EXIT_INTERRUPTED.
/// While an InterruptGuard exists too, the first signal is only counted. After destruction of the
/// watch, the signals have no effect. The main thread makes one object.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

 private:
  std::thread waits_;
};

/// While this object lives, interrupts are counted, beginning at 0, and the first interrupt does
/// not end the program. Copies of a signal that the same sender sends within 0.1 s, as `timeout`
/// does, count once. All SIGHUP signals together also count once.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  Handlers old_;
};

/// Number of interrupts since the most recent InterruptGuard was made.
int count_interrupts();
inline bool was_interrupted() { return count_interrupts() != 0; }

}  // namespace laboratory
