#pragma once
// The program's end at a signal: what is undone then, as files half written, folders, processes;
// and signals that have to wait.
#include <signal.h>

#include <functional>
#include <list>
#include <span>

namespace base {

/// While one lives in a thread, the program does not end early: a thing is made, and its Undo with
/// it, in one section. Where the program is about to end, the constructor does not return. Sections
/// are short and may be nested.
class Undivided {
 public:
  Undivided();
  ~Undivided();
  Undivided(const Undivided&) = delete;
  Undivided& operator=(const Undivided&) = delete;
};

/// What is to be done if the program ends early while this lives.
class Undo {
 public:
  /// `undo` runs in another thread, while no thread is in a section; what it throws is dropped.
  explicit Undo(std::function<void()> undo);
  ~Undo();
  Undo(const Undo&) = delete;
  Undo& operator=(const Undo&) = delete;

 private:
  std::list<std::function<void()>>::iterator place_;
};

/// Lets no thread into a section from now on. A signal handler may call it.
void request_early_end() noexcept;

/// Waits for the threads that are in sections, then undoes everything, the latest first. The caller
/// ends the program.
void undo_all();

/// While it lives, these signals wait, as far as the thread goes that made it. Threads and child
/// processes that this thread begins meanwhile hold them from their start on.
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
