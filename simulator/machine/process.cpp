#include "simulator/machine/process.hpp"

#include <cmath>

#include "simulator/machine/processor.hpp"

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

constexpr std::size_t STACK_BYTES = 128 * 1024;  // host memory; pages are touched on use

// Stacks are used again, since the branches of a PAR come and go.
class StackPool {
 public:
  boost::context::stack_context allocate() {
    if (free_.empty()) return boost::context::fixedsize_stack(STACK_BYTES).allocate();
    const auto stack = free_.back();
    free_.pop_back();
    return stack;
  }
  void deallocate(boost::context::stack_context& stack) noexcept { free_.push_back(stack); }
  ~StackPool() {
    for (auto& stack : free_) boost::context::fixedsize_stack(STACK_BYTES).deallocate(stack);
  }

 private:
  std::vector<boost::context::stack_context> free_;
};
StackPool stacks;

struct PooledStack {
  boost::context::stack_context allocate() { return stacks.allocate(); }
  void deallocate(boost::context::stack_context& stack) noexcept { stacks.deallocate(stack); }
};

Process* executing = nullptr;
ProcessId last_id = 0;

// Unwinds the body of a process that is destroyed before it has ended.
struct Cancelled {};

}  // namespace

Process& this_process() {
  if (!executing)
    throw base::InvariantBroken("a process's operation was called outside of any process");
  return *executing;
}

Process::Process(Processor& processor, std::string name, Priority priority, Body body)
    : processor_(processor), id_(++last_id), name_(std::move(name)), priority_(priority) {
  auto entry = [this, body = std::move(body)](boost::context::fiber&& scheduler) {
    arrived(nullptr, &scheduler_stack, &scheduler_stack_size);
    scheduler_ = std::move(scheduler);
    try {
      if (!cancelled_) body();
      if (!cancelled_ && debt_.value > 0) sync();  // it ends when its own time has come
    } catch (const Cancelled&) {
    } catch (const std::exception&) {
      processor_.fail(std::current_exception());
    }
    state_ = State::ended;
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

Process::~Process() {
  cancelled_ = true;
  while (fiber_) resume();
}

void Process::resume() {
  executing = this;
  void* kept = nullptr;
  leaving(&kept, stack_, STACK_BYTES);
  fiber_ = std::move(fiber_).resume();
  arrived(kept, nullptr, nullptr);
  executing = nullptr;
}

void Process::suspend() {
  void* kept = nullptr;
  leaving(&kept, scheduler_stack, scheduler_stack_size);
  scheduler_ = std::move(scheduler_).resume();
  arrived(kept, &scheduler_stack, &scheduler_stack_size);
  if (cancelled_) throw Cancelled{};
}

void Process::charge(Seconds duration) {
  charge(Cycles{std::llround(duration.value * processor_.clock().value)});
}

void Process::sync() {
  if (debt_.value > 0 || processor_.cpu().is_interrupted(*this)) suspend();
}

void Process::block(Wait& wait) {
  wait_ = &wait;
  waits_for_ = wait.kind();
  blocked_since_ = own_time();
  ++waits_;
  state_ = State::blocked;
  suspend();
}

Seconds Process::blocked(Wait::Kind kind) const {
  const Seconds over = blocked_[static_cast<std::size_t>(kind)];
  const bool is_under_way = state_ == State::blocked && wait_ && waits_for_ == kind;
  return is_under_way ? over + std::max(Seconds{}, processor_.cpu().lived_until() - blocked_since_)
                      : over;
}

// A process that only computes would not let the run end at its limit; nor, if there is none, at a
// failure, or when the user wants.
void Process::sync_if_much() {
  const Seconds earliest = processor_.now() + debt_ / processor_.clock();
  if (executing == this && (debt_ > MOST_DEBT || earliest > processor_.engine().until())) sync();
}

Seconds Process::now() {
  if (executing != this)
    throw Misuse(name_, processor_.now(),
                 fmt::format("now() of {} on {} was not called by itself at {:.6f} s", name_,
                             processor_.name(), processor_.now().value));
  sync();
  return processor_.now();
}

Seconds Process::own_time() const {
  const Seconds clock = processor_.now();
  return debt_.value == 0 ? clock : clock + processor_.duration(debt_);
}

}  // namespace machine
