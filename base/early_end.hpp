#pragma once
// Clean-up when a signal ends the program: removes half-written files and folders, and ends child
// processes. Also blocks signals temporarily.
#include <signal.h>

#include <functional>
#include <list>
#include <span>

namespace base {

/// A critical section that delays an early end of the program. Code in a section creates a resource
/// together with the Undo that removes it. After request_early_end(), a thread that enters a
/// section blocks for ever, unless it is inside one already. Sections must be short and may be
/// nested.
class Undivided {
 public:
  Undivided();
  ~Undivided();
  Undivided(const Undivided&) = delete;
  Undivided& operator=(const Undivided&) = delete;
};

/// An action that runs if a signal ends the program during this object's lifetime.
class Undo {
 public:
  /// `undo` runs in the thread that calls undo_all(), while no other thread is inside a critical
  /// section (Undivided). Its exceptions are ignored.
  explicit Undo(std::function<void()> undo);
  ~Undo();
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;

 private:
  std::list<std::function<void()>>::iterator place_;
};

/// Makes threads block when they enter a critical section (Undivided). Safe in a signal handler.
void request_early_end() noexcept;

/// Waits until no thread is inside a critical section, then runs the actions of all existing Undo
/// objects, newest first. The caller must end the program afterwards.
void undo_all();

/// Blocks the given signals in the constructing thread during the object's lifetime. Threads and
/// child processes that this thread starts meanwhile inherit the block.
class HeldSignals {
 public:
  explicit HeldSignals(std::span<const int> signals);
  ~HeldSignals();
  HeldSignals(const HeldSignals&) = delete;
  HeldSignals& operator=(const HeldSignals&) = delete;

 private:
  sigset_t before_;
};

}  // namespace base
