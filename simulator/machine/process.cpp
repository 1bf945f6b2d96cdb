#include "simulator/machine/process.hpp"

#include <utility>

#include "simulator/machine/faults.hpp"
#include "simulator/machine/processor.hpp"

namespace machine {

namespace {
constexpr std::size_t STACK_BYTES = 128 * 1024;  // host memory; pages are touched on use
Process* executing = nullptr;
}  // namespace

Process& this_process() {
  if (!executing) throw InvariantBroken("a process's operation was called outside of any process");
  return *executing;
}

Process::Process(Processor& processor, std::string name, Priority priority, Body body)
    : processor_(processor), name_(std::move(name)), priority_(priority) {
  auto entry = [this, body = std::move(body)](boost::context::fiber&& scheduler) {
    scheduler_ = std::move(scheduler);
    try {
      body();
      sync();                          // it ends when its own time has come
    } catch (const std::exception&) {  // not (...): unwinding a fiber must pass
      processor_.fail(std::current_exception());
    }
    state_ = State::ended;
    return std::move(scheduler_);
  };
  fiber_ = boost::context::fiber(std::allocator_arg, boost::context::fixedsize_stack(STACK_BYTES),
                                 std::move(entry));
}

void Process::resume() {
  executing = this;
  fiber_ = std::move(fiber_).resume();
  executing = nullptr;
}

void Process::suspend() { scheduler_ = std::move(scheduler_).resume(); }

void Process::sync() {
  if (debt_.value > 0 || processor_.has_lost_cpu(*this)) suspend();
}

void Process::block(const Wait& wait) {
  wait_ = &wait;
  ++waits_;
  state_ = State::blocked;
  suspend();
}

Seconds Process::now() const { return processor_.now() + debt_ / processor_.clock(); }

}  // namespace machine
