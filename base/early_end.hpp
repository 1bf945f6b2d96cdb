#pragma once
// Clean-up when a signal ends the program: removes half-written files and folders, ends child
// processes. Also blocks signals for a while.
#include <signal.h>

#include <functional>
#include <list>
#include <span>

namespace base {

/// A section that the program's early end waits for. It makes a resource together with its Undo.
/// The constructor does not return if the program is about to end. Sections are short and may be
/// nested.
class Undivided {
 public:
  Undivided();
  ~Undivided();
  Undivided(const Undivided&) = delete;
  Undivided& operator=(const Undivided&) = delete;
};

/// An action that runs if the program ends early while this object lives.
class Undo {
 public:
  /// `undo` runs in another thread while no thread is in a section; its exceptions are dropped.
  explicit Undo(std::function<void()> undo);
  ~Undo();
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;

 private:
  std::list<std::function<void()>>::iterator place_;
};

/// From now on, no thread can enter a section. A signal handler may call this function.
void request_early_end() noexcept;

/// Waits for the threads in sections, then runs every Undo, newest first. The caller ends the
/// program.
void undo_all();

/// Blocks these signals in the thread that made the object, as long as the object lives. Threads
/// and child processes that this thread starts meanwhile inherit the block.
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
