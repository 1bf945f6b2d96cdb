#pragma once
// What the user asks for with Ctrl-C, SIGINT or SIGTERM. One that was ignored when the program
// began, as nohup and scripts' background jobs have it, stays ignored.

#include <array>
#include <csignal>
#include <iterator>
#include <thread>

namespace laboratory {

inline constexpr int ASKS_TO_END[] = {SIGINT, SIGTERM};
inline constexpr int EXIT_INTERRUPTED = 130;
inline constexpr const char* INTERRUPTED = "interrupted; only what was done is kept";

using Handlers = std::array<void (*)(int), std::size(ASKS_TO_END)>;

/// While it lives, these signals end the program wherever it is, with what is half done undone
/// (base/early_end.hpp), INTERRUPTED on standard error and EXIT_INTERRUPTED; but the first one that
/// an InterruptGuard counts does not. When it goes, the program has done its work: the signals have
/// no effect any more. Made once, by the main thread.
class InterruptWatch {
 public:
  InterruptWatch();
  ~InterruptWatch();
  InterruptWatch(const InterruptWatch&) = delete;
  InterruptWatch& operator=(const InterruptWatch&) = delete;

 private:
  std::thread waits_;
};

/// While it lives, these signals are counted, from 0, instead of ending the program.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

 private:
  Handlers old_;
};

/// How often the user has interrupted since the last guard was made.
int count_interrupts();
inline bool was_interrupted() { return count_interrupts() != 0; }

}  // namespace laboratory
