#pragma once
// PROC: the body of a process as a C++20 coroutine, which needs no stack.
//
//   Proc forward(Channel<Packet>& from, Channel<Packet>& to) {
//     for (;;) co_await to.output(co_await from.input());
//   }
//
// A Proc takes a few hundred bytes of host memory, whereas a stack takes at least a page. With
// Procs, larger machines fit into the host's caches.
#include <coroutine>
#include <exception>
#include <utility>

namespace machine {

class Process;
Process& this_process();

/// An action of a process that may have to wait for other processes or for simulated time.
class Operation {
 public:
  /// Starts or continues the operation. Returns true if it is complete. If it returns false, the
  /// process yields the CPU, and go_on() is called again when the process next runs.
  virtual bool go_on(Process& self) = 0;
  /// Result of `co_await operation`. Called when the operation is complete.
  void await_resume() const {}

 protected:
  ~Operation() = default;
};

/// Body of a process; another Proc may wait for it with co_await. A Proc waits only by co_await,
/// for channel operations, ALTs and Sync. Functions that need a stack (Channel::out, pri_alt,
/// read_timer, PAR) throw InvariantBroken. A Proc must co_await Sync() at least once in 2^30 cycles
/// of computation, and before it uses a channel end that another process has used.
class [[nodiscard]] Proc final : public Operation {
 public:
  struct promise_type;
  using Frame = std::coroutine_handle<promise_type>;

  Proc() = default;  ///< makes a Proc without a body
  Proc(Proc&& other) noexcept : frame_(std::exchange(other.frame_, {})) {}
  Proc& operator=(Proc&& other) noexcept {
    std::swap(frame_, other.frame_);
    return *this;
  }
  ~Proc() {
    if (frame_) frame_.destroy();
  }

  explicit operator bool() const { return frame_ != nullptr; }
  bool go_on(Process& self) override;

 private:
  explicit Proc(Frame frame) : frame_(frame) {}
  Frame frame_;
};

struct Proc::promise_type {
  Operation* waits_in = nullptr;
  std::exception_ptr failure;  // exception of the operation waited for, to be rethrown in the body

  // Awaiter of an operation: runs it until it is complete, then fetches its result.
  template <class SomeOperation>
  struct Awaited {
    SomeOperation& operation;
    promise_type& promise;
    bool await_ready() { return operation.go_on(this_process()); }
    void await_suspend(Frame /*body*/) { promise.waits_in = &operation; }
    decltype(auto) await_resume() {
      if (promise.failure) std::rethrow_exception(std::exchange(promise.failure, nullptr));
      return operation.await_resume();
    }
  };
  template <class SomeOperation>
  Awaited<SomeOperation> await_transform(SomeOperation&& operation) {
    return {operation, *this};
  }

  Proc get_return_object() { return Proc(Frame::from_promise(*this)); }
  std::suspend_always initial_suspend() noexcept { return {}; }
  std::suspend_always final_suspend() noexcept { return {}; }
  void return_void() {}
  void unhandled_exception() { throw; }  // the exception leaves go_on()
};

inline bool Proc::go_on(Process& self) {
  promise_type& promise = frame_.promise();
  try {
    if (promise.waits_in && !promise.waits_in->go_on(self)) return false;
  } catch (...) {
    promise.failure = std::current_exception();
  }
  promise.waits_in = nullptr;
  if (!frame_.done()) frame_.resume();
  return frame_.done();
}

}  // namespace machine
