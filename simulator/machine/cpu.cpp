#include "simulator/machine/cpu.hpp"

#include <cmath>

#include "simulator/machine/processor.hpp"

namespace machine {

namespace {
// Rounding tolerance when a date falls on a tick; unit: time slice periods.
constexpr double HAIR = 1e-9;

template <class Queue>
Process& take_first(Queue& queue) {
  Process& first = queue.front();
  queue.pop_front();
  return first;
}

}  // namespace

std::uint32_t CpuDiary::number_of(const std::string& name) {
  if (!observer_) return 0;
  const auto next = static_cast<std::uint32_t>(numbers_.size());
  const auto [place, added] = numbers_.emplace(name, next);
  if (added) observer_->name_process(processor_, next, name);
  return place->second;
}

void CpuDiary::note(const Process& process, Observer::Doing doing, Seconds from, Seconds to) {
  if (observer_ && to > from) spans_.push_back({process.trace_id(), doing, from, to});
}

void CpuDiary::tell_past(Seconds now) {
  auto over = spans_.begin();
  for (; over != spans_.end() && over->to <= now; ++over)
    observer_->ran(processor_, over->process, over->doing, over->from, over->to);
  spans_.erase(spans_.begin(), over);
}

void CpuDiary::stretch(const Stretch& stretch) {
  for (Span& span : spans_) {
    span.from = stretch(span.from);
    span.to = stretch(span.to);
  }
}

void CpuDiary::flush(Seconds now) {
  for (const Span& span : spans_)
    if (now > span.from)
      observer_->ran(processor_, span.process, span.doing, span.from, std::min(span.to, now));
  spans_.clear();
}

std::vector<CpuDiary::Span> CpuDiary::untold(Seconds now) const {
  std::vector<Span> begun;
  for (Span span : spans_) {
    span.to = std::min(span.to, now);
    if (span.to > span.from) begun.push_back(span);
  }
  return begun;
}

void Cpu::make_ready(Process& process, Seconds at) {
  if (process.state_ != Process::State::blocked)
    throw base::InvariantBroken(
        fmt::format("{} was made ready, but it was not waiting", process.name()));
  if (stopped()) return;
  process.state_ = Process::State::ready;
  process.ready_at_ = at;
  if (process.wait_)
    process.blocked_[static_cast<std::size_t>(process.waits_for_)] +=
        std::max(Seconds{}, at - process.blocked_since_);
  const bool high = process.priority_ == Priority::high;
  if (high && is_coming_back() && now() <= low_.way_back_from) stay_away();
  if (high && running_ && running_->priority_ == Priority::low) return preempt(process);
  // Processes are served by the date at which they became ready. The queue is sorted by this date,
  // because a process may become ready at a date ahead of the clock.
  auto& queue = high ? high_queue_ : low_queue_;
  auto place = queue.end();
  while (place != queue.begin() && std::prev(place)->ready_at_ > at) --place;
  queue.insert(place, process);
  if (!running_) return dispatch_when_free();
  if (!high && low_.computing && !interrupted_) arm_low_timer();
}

void Cpu::dispatch_when_free() {
  if (!std::exchange(dispatching_, true)) ask_dispatch();
}

void Cpu::ask_dispatch() {
  const auto then = [this, id = ++dispatch_id_] {
    if (id != dispatch_id_) return engine_.ignore_event();
    // DMA has meanwhile delayed the end of the last process, so the CPU is still busy.
    if (free_at_ > now()) return ask_dispatch();
    dispatch();
  };
  if (free_at_ > now() || has_come_to_link_)
    engine_.last_at(std::max(now(), free_at_), then);
  else
    engine_.soon(then);
}

void Cpu::dispatch() {
  dispatching_ = false;
  if (stopped()) return engine_.ignore_event();
  if (!high_queue_.empty()) {
    execute(take_first(high_queue_));
  } else if (interrupted_) {
    resume_interrupted();
  } else if (!low_queue_.empty()) {
    begin_slice(take_first(low_queue_));
  }
}

void Cpu::execute(Process& process) {
  if (stopped()) return engine_.ignore_event();
  running_ = &process;
  if (process.state_ == Process::State::ready) ++use_.dispatches;
  process.state_ = Process::State::running;
  process.resume();
  if (processor_.failure()) return;
  const Seconds time = duration(process.debt_);
  const bool done = process.state_ != Process::State::running;
  process.paying_ = std::exchange(process.debt_, {});
  process.paid_for_ = {};
  if (process.priority_ == Priority::high) {
    account_high(process, time);
    if (done) return release(process, high_.until);
    process.paid_for_ = time;
    high_.computing = true;
    end_high_at(high_.until);
  } else {
    if (!done) return compute(process, {time.value * speed_});
    if (time.value > 0)
      throw base::InvariantBroken(
          process.name() + " left the CPU at low priority before it had used all its cycles");
    release(process, now());
  }
}

void Cpu::account_high(const Process& process, Seconds time) {
  use_.busy_high += time;
  high_.until = now() + time;
  if (diary_.has_observer()) {
    diary_.tell_past(now());
    const Seconds switched =
        high_.preempting ? now() + duration(model_.scheduler.preemption) : now();
    diary_.note(process, Observer::Doing::switching, now(), switched);
    diary_.note(process, Observer::Doing::high, switched, high_.until);
  }
  high_.preempting = false;
}

// Schedules a callback for the process: with the process's rank among simultaneous events, if it
// has one.
void Cpu::at(Seconds date, const Process& process, auto then) {
  if (process.has_rank())
    engine_.ranked_at(date, process.rank_, then);
  else
    engine_.at(date, then);
}

// Schedules the end of the present computation of the running high-priority process.
void Cpu::end_high_at(Seconds date) {
  at(date, *running_, [this, id = ++high_.id] {
    if (id != high_.id) return engine_.ignore_event();
    if (high_.until > now()) return end_high_at(high_.until);  // DMA has meanwhile delayed the end
    high_.computing = false;
    has_come_to_link_ = running_->has_rank();
    execute(*running_);
    has_come_to_link_ = false;
  });
}

void Cpu::release(Process& process, Seconds free_at) {
  // The last instruction of `process` made a high-priority process ready and ended `process`. The
  // pre-emption is taken back, because there was no state to save.
  if (interrupted_ == &process) {
    interrupted_ = nullptr;
    high_.preempting = false;
    --use_.preemptions;
    running_->debt_ += {-model_.scheduler.preemption.value};
    return;
  }
  running_ = nullptr;
  free_at_ = free_at;
  if (free_at > now()) last_high_ = &process;
  if (interrupted_ && high_queue_.empty()) return resume_interrupted();
  if (interrupted_ || ready() > 0) dispatch_when_free();
}

// Pre-empts the running low-priority process in favour of the high-priority process `high`.
void Cpu::preempt(Process& high) {
  interrupted_ = running_;
  running_ = &high;
  if (low_.computing) stop_low();
  ++use_.preemptions;
  high_.preempting = true;
  high.debt_ += model_.scheduler.preemption;
  engine_.soon([this, &high] { execute(high); });
}

// Stops the computation of the low-priority process that was pre-empted. Before low_.since, the CPU
// was still switching back to that process, so the process has not computed since then.
void Cpu::stop_low() {
  low_.left = speed_ * (low_.end - std::max(now(), low_.since));
  if (low_.since <= now()) return account_low();
  use_.busy_high += switched_back(now());
  diary_.note(*interrupted_, Observer::Doing::switching, low_.way_back_from, now());
  low_.way_back_from = NEVER;
}

// Switches back to the pre-empted low-priority process at the date free_at_. The switch is
// cancelled if a high-priority process becomes ready by then.
void Cpu::resume_interrupted() {
  running_ = std::exchange(interrupted_, nullptr);
  low_.way_back_from = std::max(now(), free_at_);
  foresee_way_back();
  arm_low_timer();
}

void Cpu::foresee_way_back() {
  low_.since = low_.way_back_from + duration(model_.scheduler.return_to_low);
  low_.end = low_.since + Seconds{low_.left.value / speed_};
}

// Cancels a planned switch back to the low-priority process, because a high-priority process became
// ready before the switch began.
void Cpu::stay_away() {
  interrupted_ = std::exchange(running_, nullptr);
  low_.way_back_from = NEVER;
}

// The next two functions convert between dates and numbers of time slice periods since date 0.
double Cpu::slices(Seconds date) const {
  return date / (model_.scheduler.slice / model_.cpu.clock);
}
Seconds Cpu::tick_of_slices(double tick) const {
  return tick * (model_.scheduler.slice / model_.cpu.clock);
}

void Cpu::begin_slice(Process& low) {
  low_.slice_end = tick_of_slices(std::floor(slices(now()) + HAIR) + 2);
  low_.gives_way_at = NEVER;
  if (low.remaining_.value <= 0) return execute(low);
  ++use_.dispatches;
  low.state_ = Process::State::running;
  running_ = &low;
  compute(low, std::exchange(low.remaining_, {}));
}

void Cpu::compute(Process& low, Seconds time) {
  low_.computing = true;
  low_.since = now();
  low_.end = now() + Seconds{time.value / speed_};
  low_.left = time;
  // If the process is the interrupted one, the timer is set when it resumes.
  if (interrupted_ != &low) arm_low_timer();
}

// Finds the date at which the running process must yield to the first low-priority process in the
// queue. This date may change: if the queued process became ready at a date ahead of the clock,
// another process may still overtake it, or DMA may move the date.
void Cpu::find_end_of_slice() {
  if (low_queue_.empty()) return;
  low_.gives_way_at = std::max(
      low_.slice_end, tick_of_slices(std::ceil(slices(low_queue_.front().ready_at_) - HAIR)));
}

void Cpu::arm_low_timer() {
  find_end_of_slice();
  const Seconds gives_way = std::max({now(), low_.gives_way_at, low_.since});
  const Seconds at = std::min(low_.end, gives_way);
  // An earlier timer may stay set. When it fires too early, because pre-emption has delayed the end
  // of the computation, it is set again.
  const auto rank = running_->rank_;
  if (low_timer_.armed && low_timer_.at <= at && (low_timer_.at < at || low_timer_.rank == rank))
    return;
  low_timer_ = {true, rank, at, low_timer_.id + 1};
  this->at(at, *running_, [this, id = low_timer_.id] {
    if (id != low_timer_.id) return engine_.ignore_event();
    low_timer_.armed = false;
    low_timer();
  });
}

void Cpu::low_timer() {
  // The timer will be set again when the CPU resumes the process.
  if (interrupted_ || !low_.computing) return;
  Process& low = *running_;
  const Seconds left = low_.end - now();
  find_end_of_slice();
  const bool gives_way = now() >= low_.gives_way_at && now() >= low_.since;
  if (left.value > 0 && !gives_way) return arm_low_timer();
  account_low();
  low_.computing = false;
  if (left.value <= 0) return execute(low);
  low.remaining_ = speed_ * left;
  low.state_ = Process::State::ready;
  low.ready_at_ = now();
  low_queue_.push_back(low);
  running_ = nullptr;
  dispatch();
}

void Cpu::account_low() {
  Process& low = interrupted_ ? *interrupted_ : *running_;
  const Seconds computed = now() - low_.since;
  use_.busy_low += computed;
  low.paid_for_ += computed;
  use_.busy_high += switched_back(now());
  const Seconds way_back_from = std::exchange(low_.way_back_from, NEVER);
  if (!diary_.has_observer()) return;
  diary_.tell_past(now());
  if (way_back_from < NEVER)
    diary_.note(low, Observer::Doing::switching, way_back_from, low_.since);
  diary_.note(low, Observer::Doing::low, low_.since, now());
}

void Cpu::set_stolen(std::size_t thief, double share) {
  stolen_.at(thief) = share;
  double stolen = 0;
  for (double s : stolen_) stolen += s;
  const double speed = std::max(1 - stolen, model_.memory.least_share);
  if (speed == speed_ || stopped()) return;
  use_.stolen_idle += stolen_idle(now());
  speed_since_ = now();
  busy_then_ = busy_by(now());
  const double before = std::exchange(speed_, speed);
  stretch({now(), before / speed});
}

void Cpu::stretch(const Stretch& stretch) {
  if (high_.until > stretch.now) {
    const Seconds until = stretch(high_.until);
    const Seconds more = until - std::exchange(high_.until, until);
    use_.busy_high += more;
    diary_.stretch(stretch);
    for (auto* queue : {&high_queue_, &low_queue_})
      for (Process& process : *queue) process.stretch(stretch);
    if (high_.computing) {
      running_->paid_for_ += more;
      // A later end needs no new event: the pending event fires too early and is then set again.
      if (stretch.ratio < 1) end_high_at(until);
      return;
    }
  }
  if (free_at_ > stretch.now) {
    free_at_ = stretch(free_at_);
    last_high_->stretch(stretch);
    if (dispatching_ && stretch.ratio < 1) ask_dispatch();
  }
  if (!low_.computing || interrupted_) return;
  if (is_coming_back() && low_.way_back_from >= stretch.now) {
    low_.way_back_from = stretch(low_.way_back_from);
    foresee_way_back();
  } else {
    low_.since = stretch(low_.since);
    low_.end = stretch(low_.end);
  }
  if (stretch.ratio < 1) arm_low_timer();
}

std::vector<CpuDiary::Span> Cpu::untold() const {
  auto spans = diary_.untold(now());
  if (low_.computing && !interrupted_ && now() > low_.since && diary_.has_observer())
    spans.push_back({running_->trace_id(), Observer::Doing::low, low_.since, now()});
  return spans;
}

Seconds Cpu::least_left(const Process& process) const {
  if (&process == interrupted_) return low_.computing ? low_.left : Seconds{};
  if (&process != running_) return process.remaining_;
  if (process.priority_ == Priority::high)
    return high_.computing ? speed_ * (high_.until - now()) : Seconds{};
  return low_.computing ? speed_ * (low_.end - std::max(now(), low_.since)) : Seconds{};
}

CpuUse Cpu::use_by(Seconds date) const {
  CpuUse use = use_;
  use.busy_high += switched_back(date) - high_after(date);
  use.busy_low += low_before(date);
  use.stolen_idle += stolen_idle(std::min(date, stopped_at_));
  return use;
}

// The part of the time counted in use_.busy_high that lies after `date`.
Seconds Cpu::high_after(Seconds date) const { return std::max(Seconds{}, high_.until - date); }

// Duration of the present switch back to the low-priority process, up to `date`. It is not yet
// counted in use_.
Seconds Cpu::switched_back(Seconds date) const {
  if (!is_coming_back()) return {};
  return std::max(Seconds{}, std::min(date, low_.since) - low_.way_back_from);
}

// Computation time of the low-priority process up to `date` that is not yet counted in use_.
Seconds Cpu::low_before(Seconds date) const {
  const bool computes = low_.computing && !interrupted_ && date > low_.since;
  return computes ? date - low_.since : Seconds{};
}

Seconds Cpu::busy_by(Seconds date) const {
  return use_.busy() - high_after(date) + switched_back(date) + low_before(date);
}

// Idle time of the CPU lost to DMA and the companion since the last change of the CPU's speed.
Seconds Cpu::stolen_idle(Seconds date) const {
  if (speed_ == 1) return {};
  const Seconds idle = date - speed_since_ - (busy_by(date) - busy_then_);
  return (1 - speed_) * idle;
}

void Cpu::stop() {
  const bool on_way_back = low_.computing && !interrupted_ && low_.since > now();
  if (on_way_back) {
    diary_.note(*running_, Observer::Doing::switching, low_.way_back_from, now());
    use_.busy_high += switched_back(now());
    low_.way_back_from = NEVER;
  }
  flush_observer();  // also counts the computation of a low-priority process
  if (high_.until > now()) {
    use_.busy_high -= high_.until - now();
    high_.until = now();
  }
  stopped_at_ = now();
  running_ = interrupted_ = nullptr;
  high_queue_.clear();
  low_queue_.clear();
  high_.computing = low_.computing = false;
  ++high_.id;  // pending events with older numbers have no effect
  ++low_timer_.id;
  ++dispatch_id_;
}

void Cpu::name_for_observer(Process& process) {
  process.trace_id_ = diary_.number_of(process.name());
}

void Cpu::flush_observer() {
  if (low_.computing && !interrupted_ && now() > low_.since) {
    account_low();
    low_.since = now();
  }
  diary_.flush(now());
}

}  // namespace machine
