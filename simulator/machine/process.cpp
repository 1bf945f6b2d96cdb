#include "simulator/machine/process.hpp"

#include "simulator/machine/processor.hpp"

namespace machine {

namespace {

// Exception that unwinds the stack of a process that is destroyed before it has ended.
struct Cancelled {};

}  // namespace

void throw_outside_of_process() {
  throw base::InvariantBroken("a process's operation was called outside of any process");
}

Process::Process(Processor& processor, std::string name, Priority priority, Body body)
    : processor_(processor),
      priority_(priority),
      coroutine_(processor.engine().make_coroutine(processor.id(), name, [this] { live(); })),
      id_(processor.make_id()),
      body_(std::move(body)),
      name_(std::move(name)) {}

Process::Process(Processor& processor, std::string name, Priority priority, Proc proc)
    : processor_(processor),
      priority_(priority),
      proc_(std::move(proc)),
      id_(processor.make_id()),
      name_(std::move(name)) {}

Process::~Process() {
  cancelled_ = true;
  while (coroutine_ && !coroutine_->has_ended()) resume();
  // Destructors of the body's variables may call this_process().
  Process* const other = std::exchange(executing, this);
  proc_ = {};
  executing = other;
}

void Process::live() {
  try {
    const Body body = std::move(body_);
    if (!cancelled_) body();
    // The process ends only when the clock has reached its own time, which includes all charged
    // cycles.
    if (!cancelled_ && !ends_by_this_) sync();
  } catch (const Cancelled&) {
  } catch (const std::exception&) {
    processor_.fail(std::current_exception());
  }
  state_ = State::ended;
}

void Process::live_on() {
  try {
    if (proc_ && !proc_.go_on(*this)) return;
    proc_ = {};
    // The process ends only when the clock has reached its own time, which includes all charged
    // cycles.
    if (!ends_by_this_ && must_sync()) return;
  } catch (const std::exception&) {
    processor_.fail(std::current_exception());
  }
  state_ = State::ended;
}

void Process::resume() {
  executing = this;
  if (!coroutine_)
    live_on();
  else if (cancelled_ || !operation_ || go_on_in_operation())
    coroutine_->resume();
  executing = nullptr;
}

// Suspends the body until its operation is complete. Meanwhile the CPU continues the operation
// outside of the body's stack.
void Process::suspend_in(Operation& operation) {
  operation_ = &operation;
  leave_body();
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

bool Process::go_on_in_operation() {
  try {
    if (!operation_->go_on(*this)) return false;
  } catch (const std::exception&) {
    failure_ = std::current_exception();
  }
  operation_ = nullptr;
  return true;
}

void Process::throw_without_stack() const {
  throw base::InvariantBroken(name_ + " has no stack to wait on: expected co_await in a Proc");
}

void Process::suspend() {
  require_stack();
  leave_body();
}

void Process::leave_body() {
  coroutine_->suspend();
  if (!cancelled_) return;
  operation_ = nullptr;
  throw Cancelled{};
}

void Process::charge(Seconds duration) {
  charge(round_to_cycles(duration.value * processor_.clock().value));
}

void Process::start_wait(Wait& wait) {
  wait_ = &wait;
  waits_for_ = wait.kind();
  blocked_since_ = own_time();
  ++waits_;
  state_ = State::blocked;
  note_end_of_run();
}

void Process::note_end_of_run() {
  Engine& engine = processor_.engine();
  // The process blocked at a date beyond the time limit. An event at this date makes the run end at
  // its limit.
  if (blocked_since_ > engine.until()) engine.at(blocked_since_, [] {});
}

// Moves the dates at which a process blocked or became ready, if they are ahead of the clock.
void Process::stretch(const Stretch& stretch) {
  if (state_ == State::ready) {
    const Seconds waited = ready_at_ - blocked_since_;
    ready_at_ = stretch(ready_at_);
    blocked_since_ = stretch(blocked_since_);
    const Seconds more = ready_at_ - blocked_since_ - waited;
    if (wait_ && waited.value > 0) blocked_[static_cast<std::size_t>(waits_for_)] += more;
    return;
  }
  if (state_ != State::blocked || blocked_since_ <= stretch.now) return;
  blocked_since_ = stretch(blocked_since_);
  note_end_of_run();
  wait_->on_stretch(*this, stretch);
}

void Process::block(Wait& wait) {
  require_stack();
  start_wait(wait);
  suspend();
}

Seconds Process::blocked(Wait::Kind kind) const {
  const Seconds over = blocked_[static_cast<std::size_t>(kind)];
  const bool is_under_way = state_ == State::blocked && wait_ && waits_for_ == kind;
  return is_under_way ? over + std::max(Seconds{}, processor_.cpu().lived_until() - blocked_since_)
                      : over;
}

// Syncs if too many charged cycles are unpaid, or if they extend beyond the time limit of the run.
// Without this sync, a process that only computes would never stop, and the run could not end at
// its limit, at a failure or on request. A Proc cannot sync here; if too many of its cycles are
// unpaid, it throws.
void Process::sync_if_much() {
  if (executing != this) return;
  const Seconds earliest = processor_.now() + debt_ / processor_.clock();
  const bool is_past_end = has_stack() && earliest > processor_.engine().until();
  if (debt_ > MOST_DEBT || is_past_end) sync();
}

Seconds Process::now() {
  if (executing != this)
    throw Misuse(name_, processor_.now(),
                 fmt::format("now() of {} on {} was called outside this process at {:.6f} s", name_,
                             processor_.name(), processor_.now().value));
  sync();
  return processor_.now();
}

}  // namespace machine
