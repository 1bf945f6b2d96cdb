#include "simulator/machine/processor.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.hpp"

namespace machine {

namespace {
constexpr double HAIR = 1e-9;  // of a time slice: a date that is a tick may be rounded off it
}

Processor::Processor(Engine& engine, const Model& model, int id, std::string name,
                     std::uint64_t memory, double software_factor)
    : engine_(engine),
      model_(model),
      id_(id),
      name_(std::move(name)),
      memory_(name_, memory),
      software_factor_(software_factor) {}

Process& Processor::start(std::string name, Priority priority, Process::Body body) {
  processes_.push_back(
      std::make_unique<Process>(*this, std::move(name), priority, std::move(body)));
  Process& process = *processes_.back();
  process.state_ = Process::State::blocked;
  name_for_observer(process);
  make_ready(process, now());
  return process;
}

void Processor::remove(const Process& process) {
  if (process.state_ != Process::State::ended)
    throw base::InvariantBroken(process.name() + " was removed but has not ended");
  const auto last = std::find_if(processes_.rbegin(), processes_.rend(),
                                 [&](const auto& p) { return p.get() == &process; });
  const auto place = std::next(last).base();
  if (removed_.size() >= sweep_at_) {  // seldom: many may wait for their last wake_at
    std::erase_if(removed_, [](const auto& p) { return p->wake_ups_ == 0; });
    sweep_at_ = 2 * removed_.size() + 16;
  }
  if (process.wake_ups_ > 0) removed_.push_back(std::move(*place));
  processes_.erase(place);
}

void Processor::wake_at(Seconds date, Process& process, std::uint64_t wait, const bool* unless) {
  ++process.wake_ups_;
  engine_.at(date, [&process, wait, unless] {
    --process.wake_ups_;
    Processor& self = process.processor();
    const bool waits = process.state() == Process::State::blocked && process.waits() == wait;
    if (waits && !self.stopped() && !(unless && *unless))
      self.make_ready(process, self.now());
    else
      self.engine_.ignore_event();
  });
}

void Processor::make_ready(Process& process, Seconds at) {
  if (process.state_ != Process::State::blocked)
    throw base::InvariantBroken(
        fmt::format("{} was made ready but is not waiting", process.name()));
  if (stopped()) return;
  process.state_ = Process::State::ready;
  process.ready_at_ = at;
  if (process.wait_)
    process.blocked_[static_cast<std::size_t>(process.waits_for_)] +=
        std::max(Seconds{}, at - process.blocked_since_);
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
  if (stopped()) return engine_.ignore_event();
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
  if (stopped()) return engine_.ignore_event();
  running_ = &process;
  if (process.state_ == Process::State::ready) ++use_.dispatches;
  process.state_ = Process::State::running;
  process.resume();
  if (failure_) return;
  const Seconds time = duration(process.debt_);
  const bool done = process.state_ != Process::State::running;
  process.debt_ = {};
  if (process.priority_ == Priority::high) {
    use_.busy_high += time;
    high_until_ = now() + time;
    if (observer_) {
      const Seconds switched = preempting_ ? now() + duration(model_.scheduler.preemption) : now();
      tell(process, Observer::Doing::switching, now(), switched);
      tell(process, Observer::Doing::high, switched, high_until_);
    }
    preempting_ = false;
    if (done) return release(process, high_until_);
    high_computing_ = true;
    end_high_at(high_until_);
  } else {
    if (!done) return compute(process, {time.value * speed_});
    if (time.value > 0)
      throw base::InvariantBroken(process.name() +
                                  " left the CPU at low priority with unpaid cycles");
    release(process, now());
  }
}

// The high-priority process that runs has computed until then.
void Processor::end_high_at(Seconds date) {
  engine_.at(date, [this, id = ++high_id_] {
    if (id != high_id_) return engine_.ignore_event();
    high_computing_ = false;
    execute(*running_);
  });
}

void Processor::release(Process& process, Seconds free_at) {
  if (interrupted_ == &process) {  // by its last instruction: it gave way, nothing is to be saved
    interrupted_ = nullptr;
    preempting_ = false;
    --use_.preemptions;
    running_->charge({-model_.scheduler.preemption.value});
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
    low_left_ = speed_ * (low_end_ - std::max(now(), low_since_));
    if (low_since_ > now()) {
      const Seconds left = std::max(now(), free_at_);
      use_.busy_high -= low_since_ - left;  // no more on its way back
      high_until_ = left;
      tell(*interrupted_, Observer::Doing::switching, way_back_from_, left);
      way_back_from_ = NEVER;
    } else {
      account_low();
    }
  }
  if (free_at_ > now()) {  // the last high-priority process is still there: no pre-emption
    engine_.at(free_at_, [this, &high] { execute(high); });
    return;
  }
  ++use_.preemptions;
  preempting_ = true;
  high.charge(model_.scheduler.preemption);
  engine_.soon([this, &high] { execute(high); });
}

// From free_at_ on the CPU goes back to the low-priority process.
void Processor::resume_interrupted() {
  running_ = std::exchange(interrupted_, nullptr);
  const Seconds back = duration(model_.scheduler.return_to_low);
  way_back_from_ = free_at_;
  use_.busy_high += back;
  low_since_ = high_until_ = free_at_ + back;
  low_end_ = low_since_ + Seconds{low_left_.value / speed_};
  arm_low_timer();
}

// The clock in time slice periods, and the date of one of its ticks.
double Processor::slices(Seconds date) const { return date / (model_.scheduler.slice / clock()); }
Seconds Processor::tick_of_slices(double tick) const {
  return tick * (model_.scheduler.slice / clock());
}

void Processor::begin_slice(Process& low) {
  slice_end_ = tick_of_slices(std::floor(slices(now()) + HAIR) + 2);
  gives_way_at_ = NEVER;
  if (low.remaining_.value <= 0) return execute(low);
  ++use_.dispatches;
  low.state_ = Process::State::running;
  running_ = &low;
  compute(low, std::exchange(low.remaining_, {}));
}

void Processor::compute(Process& low, Seconds time) {
  low_computing_ = true;
  low_since_ = now();
  low_end_ = now() + Seconds{time.value / speed_};
  low_left_ = time;
  if (interrupted_ != &low) arm_low_timer();  // else a high process came during its operation
}

void Processor::arm_low_timer() {
  if (!low_.empty() && gives_way_at_ == NEVER)
    gives_way_at_ =
        std::max(slice_end_, tick_of_slices(std::ceil(slices(low_.front()->ready_at_) - HAIR)));
  const Seconds gives_way = std::max({now(), gives_way_at_, low_since_});
  const Seconds at = std::min(low_end_, gives_way);
  // A pre-empted computation only ends later: a timer that fires early is armed again then.
  if (timer_armed_ && timer_at_ <= at) return;
  timer_armed_ = true;
  timer_at_ = at;
  engine_.at(at, [this, id = ++timer_id_] {
    if (id != timer_id_) return engine_.ignore_event();
    timer_armed_ = false;
    low_timer();
  });
}

void Processor::low_timer() {
  if (interrupted_ || !low_computing_) return;  // armed again when the CPU comes back
  Process& low = *running_;
  const Seconds left = low_end_ - now();
  const bool gives_way = now() >= gives_way_at_ && now() >= low_since_;
  if (left.value > 0 && !gives_way) return arm_low_timer();
  account_low();
  low_computing_ = false;
  if (left.value <= 0) return execute(low);
  low.remaining_ = speed_ * left;
  low.state_ = Process::State::ready;
  low.ready_at_ = now();
  low_.push_back(&low);
  running_ = nullptr;
  dispatch();
}

void Processor::account_low() {
  use_.busy_low += now() - low_since_;
  if (!observer_) return;
  const Process& low = interrupted_ ? *interrupted_ : *running_;
  if (way_back_from_ < NEVER) tell(low, Observer::Doing::switching, way_back_from_, low_since_);
  way_back_from_ = NEVER;
  tell(low, Observer::Doing::low, low_since_, now());
}

void Processor::set_stolen(std::size_t port, double share) {
  stolen_.at(port) = share;
  double stolen = 0;
  for (double s : stolen_) stolen += s;
  const double speed = std::max(1 - stolen, model_.memory.least_share);
  if (speed == speed_) return;
  const double before = std::exchange(speed_, speed);
  if (high_computing_ && high_until_ > now()) {
    const Seconds until = now() + before / speed * (high_until_ - now());
    use_.busy_high += until - high_until_;
    if (!ahead_.empty()) ahead_.back().to = until;
    end_high_at(high_until_ = until);
    return;
  }
  if (!low_computing_ || interrupted_) return;
  const Seconds since = std::max(now(), low_since_);
  low_end_ = since + before / speed * (low_end_ - since);
  if (speed > before) arm_low_timer();
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
