#pragma once
// A coroutine with its own stack.
#include <cstddef>
#include <functional>
#include <memory>

namespace machine {

class Coroutine {
 public:
  using Body = std::function<void()>;
  /// Address space of a stack. Pages get memory on first use.
  static constexpr std::size_t STACK_BYTES = 128 * 1024;

  virtual ~Coroutine() = default;
  /// Runs the body until it suspends or returns. The body must not throw.
  virtual void resume() = 0;
  /// Called by the body: returns control to the caller of resume() until the next resume().
  virtual void suspend() = 0;
  /// True after the body has returned. Only then may the coroutine be destroyed.
  bool has_ended() const { return has_ended_; }

 protected:
  bool has_ended_ = false;
};

/// Makes a coroutine that switches stacks without any scheduler.
std::unique_ptr<Coroutine> make_fiber(Coroutine::Body body);

}  // namespace machine
