#pragma once
// A function on a stack of its own, which runs by turns with those who resume it.
#include <cstddef>
#include <functional>
#include <memory>

namespace machine {

class Coroutine {
 public:
  using Body = std::function<void()>;
  static constexpr std::size_t STACK_BYTES = 128 * 1024;  ///< on the host; touched on use

  virtual ~Coroutine() = default;
  /// Enters the body, until it suspends or returns. The body must not throw.
  virtual void resume() = 0;
  /// Called by the body: back to where it was resumed, until it is resumed again.
  virtual void suspend() = 0;
  /// Whether the body has returned; only then may the coroutine be destroyed.
  bool has_ended() const { return has_ended_; }

 protected:
  bool has_ended_ = false;
};

/// A coroutine that is entered and left by a switch of stacks and nothing else.
std::unique_ptr<Coroutine> make_fiber(Coroutine::Body body);

}  // namespace machine
