#include "simulator/machine/processor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "simulator/machine/faults.hpp"

namespace machine {

Processor::Processor(Engine& engine, const Model& model, int id, std::string name,
                     std::uint64_t memory)
    : engine_(engine), model_(model), id_(id), name_(std::move(name)), memory_(name_, memory) {}

Process& Processor::start(std::string name, Priority priority, Process::Body body) {
  processes_.push_back(
      std::make_unique<Process>(*this, std::move(name), priority, std::move(body)));
  Process& process = *processes_.back();
  process.state_ = Process::State::blocked;
  make_ready(process, now());
  return process;
}

void Processor::make_ready(Process& process, Seconds at) {
  if (process.state_ != Process::State::blocked)
    throw InvariantBroken(fmt::format("{} was made ready but is not waiting", process.name()));
  process.state_ = Process::State::ready;
  process.ready_at_ = at;
  const bool high = process.priority_ == Priority::high;
  if (high && running_ && running_->priority_ == Priority::low) return preempt(process);
  // First come, first served by simulated time: a process's own time may be ahead of the clock.
  auto& queue = high ? high_ : low_;
  auto place = queue.end();
  while (place != queue.begin() && (*std::prev(place))->ready_at_ > at) --place;
  queue.insert(place, &process);
  if (!running_) return dispatch_at(free_at_);
  if (!high && low_computing_ && !interrupted_) arm_low_timer();
}

void Processor::dispatch_at(Seconds date) {
  if (std::exchange(dispatching_, true)) return;
  if (date > now())
    engine_.at(date, [this] { dispatch(); });
  else
    engine_.soon([this] { dispatch(); });
}

void Processor::dispatch() {
  dispatching_ = false;
  if (!high_.empty()) {
    Process& next = *high_.front();
    high_.pop_front();
    execute(next);
  } else if (!low_.empty()) {
    Process& next = *low_.front();
    low_.pop_front();
    begin_slice(next);
  }
}

void Processor::execute(Process& process) {
  running_ = &process;
  if (process.state_ == Process::State::ready) ++use_.dispatches;
  process.state_ = Process::State::running;
  process.resume();
  if (failure_) return;
  const Seconds time = process.debt_ / clock();
  const bool done = process.state_ != Process::State::running;
  process.debt_ = {};
  if (process.priority_ == Priority::high) {
    use_.busy_high += time;
    high_until_ = now() + time;
    if (done) return release(process, high_until_);
    engine_.at(high_until_, [this, &process] { execute(process); });
  } else {
    if (!done) return compute(process, time);
    if (time.value > 0)
      throw InvariantBroken(process.name() + " left the CPU at low priority with unpaid cycles");
    release(process, now());
  }
}

void Processor::release(Process& process, Seconds free_at) {
  if (interrupted_ == &process) {
    interrupted_ = nullptr;  // the high process that came meanwhile has the CPU
    return;
  }
  running_ = nullptr;
  free_at_ = free_at;
  if (!high_.empty()) return dispatch_at(free_at);
  if (interrupted_) return resume_interrupted();
  if (!low_.empty()) dispatch_at(free_at);
}

// A high-priority process became ready while a low one runs. If the low one was only on its way
// back, from free_at_ to low_since_, it has not computed yet.
void Processor::preempt(Process& high) {
  interrupted_ = running_;
  running_ = &high;
  if (low_computing_) {
    low_left_ = low_end_ - std::max(now(), low_since_);
    if (low_since_ > now()) {
      const Seconds left = std::max(now(), free_at_);
      use_.busy_high -= low_since_ - left;  // no more on its way back
      high_until_ = left;
    } else {
      use_.busy_low += now() - low_since_;
    }
  }
  if (free_at_ > now()) {  // the last high-priority process is still there: no pre-emption
    engine_.at(free_at_, [this, &high] { execute(high); });
    return;
  }
  ++use_.preemptions;
  high.charge(model_.scheduler.preemption);
  engine_.soon([this, &high] { execute(high); });
}

// From free_at_ on the CPU goes back to the low-priority process.
void Processor::resume_interrupted() {
  running_ = std::exchange(interrupted_, nullptr);
  const Seconds back = model_.scheduler.return_to_low / clock();
  use_.busy_high += back;
  low_since_ = high_until_ = free_at_ + back;
  low_end_ = low_since_ + low_left_;
  arm_low_timer();
}

void Processor::begin_slice(Process& low) {
  const Seconds period = model_.scheduler.slice / clock();
  slice_end_ = {(std::floor(now() / period) + 2) * period.value};
  if (low.remaining_.value <= 0) return execute(low);
  ++use_.dispatches;
  low.state_ = Process::State::running;
  running_ = &low;
  compute(low, std::exchange(low.remaining_, {}));
}

void Processor::compute(Process& low, Seconds time) {
  low_computing_ = true;
  low_since_ = now();
  low_end_ = now() + time;
  low_left_ = time;
  if (interrupted_ != &low) arm_low_timer();  // else a high process came during its operation
}

void Processor::arm_low_timer() {
  const Seconds gives_way = std::max({now(), slice_end_, low_since_});
  const Seconds at = low_.empty() ? low_end_ : std::min(low_end_, gives_way);
  // A pre-empted computation only ends later: a timer that fires early is armed again then.
  if (timer_armed_ && timer_at_ <= at) return;
  timer_armed_ = true;
  timer_at_ = at;
  engine_.at(at, [this, id = ++timer_id_] {
    if (id != timer_id_) return;
    timer_armed_ = false;
    low_timer();
  });
}

void Processor::low_timer() {
  if (interrupted_ || !low_computing_) return;  // armed again when the CPU comes back
  Process& low = *running_;
  const Seconds left = low_end_ - now();
  const bool gives_way = !low_.empty() && now() >= slice_end_ && now() >= low_since_;
  if (left.value > 0 && !gives_way) return arm_low_timer();
  use_.busy_low += now() - low_since_;
  low_computing_ = false;
  if (left.value <= 0) return execute(low);
  low.remaining_ = left;
  low.state_ = Process::State::ready;
  low.ready_at_ = now();
  low_.push_back(&low);
  running_ = nullptr;
  dispatch();
}

CpuUse Processor::use() const {
  CpuUse use = use_;
  if (high_until_ > now()) use.busy_high -= high_until_ - now();
  if (low_computing_ && !interrupted_ && now() > low_since_) use.busy_low += now() - low_since_;
  return use;
}

void Processor::fail(std::exception_ptr failure) {
  failure_ = failure;
  engine_.stop();
}

}  // namespace machine
