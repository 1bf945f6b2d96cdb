#pragma once
// A function on its own stack that alternates with the code that resumes it.
#include <cstddef>
#include <functional>
#include <memory>

namespace machine {

class Coroutine {
 public:
  using Body = std::function<void()>;
  static constexpr std::size_t STACK_BYTES = 128 * 1024;  ///< of address space; memory on first use

  virtual ~Coroutine() = default;
  /// Enters the body, until it suspends or returns. The body must not throw.
  virtual void resume() = 0;
  /// Called by the body: returns to the caller of resume(), until the next resume().
  virtual void suspend() = 0;
  /// True once the body has returned; only then may the coroutine be destroyed.
  bool has_ended() const { return has_ended_; }

 protected:
  bool has_ended_ = false;
};

/// A coroutine that only switches stacks when it is entered and left.
std::unique_ptr<Coroutine> make_fiber(Coroutine::Body body);

}  // namespace machine
