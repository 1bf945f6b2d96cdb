#pragma once
// What is undone when a signal ends the program early: files half written, folders, processes.
#include <functional>
#include <list>

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

}  // namespace base
