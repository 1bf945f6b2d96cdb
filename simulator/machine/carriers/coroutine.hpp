#pragma once
// A coroutine with its own stack.
#include <cstddef>
#include <functional>
#include <memory>

namespace machine {

class Coroutine {
 public:
  using Body = std::function<void()>;
  /// Address space of a stack in bytes. The host assigns memory to a page of it when the page is
  /// first used.
  static constexpr std::size_t STACK_BYTES = 128 * 1024;

  virtual ~Coroutine() = default;
  /// Runs the body until it suspends itself or returns. The body must not throw.
  virtual void resume() = 0;
  /// Called by the body: returns control to the caller of resume(), until resume() is called again.
  virtual void suspend() = 0;
  /// True after the body has returned. A coroutine must not be destroyed earlier.
  bool has_ended() const { return has_ended_; }

 protected:
  bool has_ended_ = false;
};

/// Makes a coroutine that switches to a stack of its own without a scheduler.
std::unique_ptr<Coroutine> make_fiber(Coroutine::Body body);

}  // namespace machine
