#include <boost/context/fiber.hpp>
#include <vector>

#include "simulator/machine/coroutine.hpp"

// The address sanitizer must be told when the stack changes; no effect on any result.
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/common_interface_defs.h>
#endif

namespace machine {

namespace {

const void* scheduler_stack = nullptr;  // the host's, as the sanitizer has told it
std::size_t scheduler_stack_size = 0;

void leaving([[maybe_unused]] void** kept, [[maybe_unused]] const void* stack,
             [[maybe_unused]] std::size_t size) {
#ifdef __SANITIZE_ADDRESS__
  __sanitizer_start_switch_fiber(kept, stack, size);
#endif
}

void arrived([[maybe_unused]] void* kept, [[maybe_unused]] const void** from,
             [[maybe_unused]] std::size_t* size) {
#ifdef __SANITIZE_ADDRESS__
  __sanitizer_finish_switch_fiber(kept, from, size);
#endif
}

// Stacks are used again, since the branches of a PAR come and go.
class StackPool {
 public:
  boost::context::stack_context allocate() {
    if (free_.empty()) return boost::context::fixedsize_stack(Coroutine::STACK_BYTES).allocate();
    const auto stack = free_.back();
    free_.pop_back();
    return stack;
  }
  void deallocate(boost::context::stack_context& stack) noexcept { free_.push_back(stack); }
  ~StackPool() {
    for (auto& stack : free_)
      boost::context::fixedsize_stack(Coroutine::STACK_BYTES).deallocate(stack);
  }

 private:
  std::vector<boost::context::stack_context> free_;
};
StackPool stacks;

struct PooledStack {
  boost::context::stack_context allocate() { return stacks.allocate(); }
  void deallocate(boost::context::stack_context& stack) noexcept { stacks.deallocate(stack); }
};

class Fiber final : public Coroutine {
 public:
  explicit Fiber(Body body) {
    auto entry = [this, body = std::move(body)](boost::context::fiber&& scheduler) {
      arrived(nullptr, &scheduler_stack, &scheduler_stack_size);
      scheduler_ = std::move(scheduler);
      body();
      has_ended_ = true;
      leaving(nullptr, scheduler_stack, scheduler_stack_size);
      return std::move(scheduler_);
    };
    PooledStack allocator;
    const auto stack = allocator.allocate();
    stack_ = static_cast<const char*>(stack.sp) - stack.size;  // it grows downwards
    fiber_ = boost::context::fiber(std::allocator_arg,
                                   boost::context::preallocated(stack.sp, stack.size, stack),
                                   allocator, std::move(entry));
  }

  void resume() override {
    void* kept = nullptr;
    leaving(&kept, stack_, STACK_BYTES);
    fiber_ = std::move(fiber_).resume();
    arrived(kept, nullptr, nullptr);
  }

  void suspend() override {
    void* kept = nullptr;
    leaving(&kept, scheduler_stack, scheduler_stack_size);
    scheduler_ = std::move(scheduler_).resume();
    arrived(kept, &scheduler_stack, &scheduler_stack_size);
  }

 private:
  boost::context::fiber fiber_, scheduler_;
  const void* stack_ = nullptr;  // lowest address, for the address sanitizer
};

}  // namespace

std::unique_ptr<Coroutine> make_fiber(Coroutine::Body body) {
  return std::make_unique<Fiber>(std::move(body));
}

}  // namespace machine
