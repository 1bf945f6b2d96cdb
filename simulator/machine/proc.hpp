#pragma once
// PROC: the body of a process without a stack, a C++20 coroutine.
//
//   Proc forward(Channel<Packet>& from, Channel<Packet>& to) {
//     for (;;) co_await to.output(co_await from.input());
//   }
//
// A Proc takes a few hundred bytes of host memory, a stack at least a page. With Procs, larger
// machines fit into the host's caches.
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
  /// process yields the CPU and calls it again when it next runs.
  virtual bool go_on(Process& self) = 0;
  /// Result of `co_await operation`, fetched when the operation is complete.
  void await_resume() const {}

 protected:
  ~Operation() = default;
};

/// A process body; another Proc may co_await it. It waits only by co_await: in channel operations,
/// ALTs and Sync. Calls that need a stack (Channel::out, pri_alt, read_timer, PAR) throw
/// InvariantBroken. It must co_await Sync() at least once in 2^30 cycles of computation, and before
/// it takes over a channel end from another process.
class [[nodiscard]] Proc final : public Operation {
 public:
  struct promise_type;
  using Frame = std::coroutine_handle<promise_type>;

  Proc() = default;  ///< without a body
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
  std::exception_ptr failure;  // exception of the awaited operation, rethrown in the body

  // The awaiter of an operation.
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
  void unhandled_exception() { throw; }  // propagates out of go_on()
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
