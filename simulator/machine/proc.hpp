#pragma once
// PROC: the body of a process that needs no stack, a C++ coroutine.
//
//   Proc forward(Channel<Packet>& from, Channel<Packet>& to) {
//     for (;;) co_await to.output(co_await from.input());
//   }
//
// Such a process takes some hundred bytes of the host, where a stack takes a page at least, and the
// host comes to it sooner.
#include <coroutine>
#include <utility>

namespace machine {

class Process;
Process& this_process();

/// What a process does that may have to wait: for others, or until its own time has come.
class Operation {
 public:
  /// Begins, or goes on from where it was. Returns whether it is over; if not, the process gives
  /// the CPU up, and calls again when it has it back.
  virtual bool go_on(Process& self) = 0;

  // co_await operation, in a Proc
  bool await_ready() { return go_on(this_process()); }
  template <class Promise>
  void await_suspend(std::coroutine_handle<Promise> waiting) {
    waiting.promise().waits_in = this;
  }
  void await_resume() const {}

 protected:
  ~Operation() = default;
};

/// A body that has not begun, is under way or has ended; another Proc may co_await it. It waits by
/// co_await alone, in operations on channels, ALTs and Sync: what needs a stack (Channel::out,
/// timers, PAR) throws InvariantBroken when it would have to wait. What an operation throws after
/// it has had to wait ends the process, and is not caught in its body.
class Proc final : public Operation {
 public:
  struct promise_type {
    Operation* waits_in = nullptr;
    Proc get_return_object() { return Proc(Coroutine::from_promise(*this)); }
    std::suspend_always initial_suspend() noexcept { return {}; }
    std::suspend_always final_suspend() noexcept { return {}; }
    void return_void() {}
    void unhandled_exception() { throw; }  // out of go_on()
  };

  Proc() = default;
  Proc(Proc&& other) noexcept : coroutine_(std::exchange(other.coroutine_, {})) {}
  Proc& operator=(Proc&& other) noexcept {
    std::swap(coroutine_, other.coroutine_);
    return *this;
  }
  ~Proc() {
    if (coroutine_) coroutine_.destroy();
  }

  explicit operator bool() const { return coroutine_ != nullptr; }
  bool go_on(Process& self) override {
    Operation*& operation = coroutine_.promise().waits_in;
    if (operation && !operation->go_on(self)) return false;
    operation = nullptr;
    if (!coroutine_.done()) coroutine_.resume();
    return coroutine_.done();
  }

 private:
  using Coroutine = std::coroutine_handle<promise_type>;
  explicit Proc(Coroutine coroutine) : coroutine_(coroutine) {}
  Coroutine coroutine_;
};

}  // namespace machine
