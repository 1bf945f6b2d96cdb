#include <sys/mman.h>

#include <boost/context/fiber.hpp>
#include <mutex>
#include <new>
#include <vector>

#include "simulator/machine/carriers/coroutine.hpp"

// The sanitizers require calls before and after each switch of stacks. These calls do not affect
// results.
#ifdef __SANITIZE_ADDRESS__
#include <sanitizer/common_interface_defs.h>
#endif
#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace machine {

namespace {

// Stack of the host thread itself, as reported by the address sanitizer.
thread_local const void* scheduler_stack = nullptr;
thread_local std::size_t scheduler_stack_size = 0;

// Registers a stack with the thread sanitizer.
class KnownStack {
 public:
#ifdef __SANITIZE_THREAD__
  ~KnownStack() { __tsan_destroy_fiber(fiber_); }
  void enter() {
    entered_from_ = __tsan_get_current_fiber();
    __tsan_switch_to_fiber(fiber_, 0);
  }
  void leave() { __tsan_switch_to_fiber(entered_from_, 0); }

 private:
  void *fiber_ = __tsan_create_fiber(0), *entered_from_ = nullptr;
#else
  void enter() {}
  void leave() {}
#endif
};

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

// A pool of stacks. Stacks are reused because branches of PARs are short-lived. They lie side by
// side in large blocks of address space. The host assigns memory page by page at first use, and
// most bodies need one page. Neighbouring stacks start at different offsets within a page;
// otherwise the frames of all waiting processes would compete for the same few cache sets.
class StackPool {
 public:
  boost::context::stack_context allocate() {
    const std::lock_guard lock(mutex_);
    if (free_.empty()) add_block();
    const auto stack = free_.back();
    free_.pop_back();
    return stack;
  }
  void deallocate(boost::context::stack_context& stack) noexcept {
    const std::lock_guard lock(mutex_);
    free_.push_back(stack);
  }
  ~StackPool() {
    for (void* block : blocks_) munmap(block, STACKS * Coroutine::STACK_BYTES);
  }

 private:
  static constexpr std::size_t STACKS = 64;  // number of stacks in a block
  // Number of different offsets within a page, and bytes between two offsets.
  static constexpr std::size_t PLACES = 16, APART = 128;

  void add_block() {
    void* block = mmap(nullptr, STACKS * Coroutine::STACK_BYTES, PROT_READ | PROT_WRITE,
                       MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (block == MAP_FAILED) throw std::bad_alloc();
    blocks_.push_back(block);
    // Reserves room now, because deallocate() must not throw and therefore must not grow the
    // vector.
    free_.reserve(blocks_.size() * STACKS);
    for (std::size_t i = STACKS; i-- > 0;) {
      const std::size_t size = Coroutine::STACK_BYTES - i % PLACES * APART;
      boost::context::stack_context stack;
      stack.size = size;
      stack.sp = static_cast<char*>(block) + i * Coroutine::STACK_BYTES + size;
      free_.push_back(stack);
    }
  }

  std::mutex mutex_;
  std::vector<void*> blocks_;
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
      known_.leave();
      return std::move(scheduler_);
    };
    PooledStack allocator;
    const auto stack = allocator.allocate();
    stack_ = static_cast<const char*>(stack.sp) - stack.size;  // lowest address of the stack
    stack_size_ = stack.size;
    fiber_ = boost::context::fiber(std::allocator_arg,
                                   boost::context::preallocated(stack.sp, stack.size, stack),
                                   allocator, std::move(entry));
  }

  void resume() override {
    void* kept = nullptr;
    leaving(&kept, stack_, stack_size_);
    known_.enter();
    fiber_ = std::move(fiber_).resume();
    arrived(kept, nullptr, nullptr);
  }

  void suspend() override {
    void* kept = nullptr;
    leaving(&kept, scheduler_stack, scheduler_stack_size);
    known_.leave();
    scheduler_ = std::move(scheduler_).resume();
    arrived(kept, &scheduler_stack, &scheduler_stack_size);
  }

 private:
  boost::context::fiber fiber_, scheduler_;
  KnownStack known_;
  const void* stack_ = nullptr;  // lowest address, needed by the address sanitizer
  std::size_t stack_size_ = 0;
};

}  // namespace

std::unique_ptr<Coroutine> make_fiber(Coroutine::Body body) {
  return std::make_unique<Fiber>(std::move(body));
}

}  // namespace machine
