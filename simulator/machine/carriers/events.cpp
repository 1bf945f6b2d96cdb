#include "simulator/machine/carriers/events.hpp"

#include <csignal>

namespace machine {

namespace {
volatile std::sig_atomic_t stop_requested = 0;
}

void request_stop() { stop_requested = 1; }

void Events::ask(double date, std::uint64_t order, Callback callback) {
  if (free_.empty()) {
    free_.push_back(static_cast<std::uint32_t>(callbacks_.size()));
    callbacks_.emplace_back();
  }
  const std::uint32_t place = free_.back();
  free_.pop_back();
  callbacks_[place] = callback;
  heap_.push({date, order, place});
}

void Events::handle_next() {
  const Event event = heap_.top();
  heap_.pop();
  free_.push_back(event.callback);
  now_ = event.date;
  handle(callbacks_[event.callback]);
}

void Events::handle(Callback callback) {
  if (now_ > until_) {
    now_ = until_;
    return stop(End::until);
  }
  if (stop_requested != 0) return stop(End::requested);
  ++handled_;
  ignored_ = false;
  callback();
  if (!ignored_) last_useful_ = now_;
  while (!soon_.empty() && !stopped_) {
    soon_now_.swap(soon_);
    for (auto& then : soon_now_) then();
    soon_now_.clear();
  }
}

void Events::stop(End why) {
  if (!stopped_) end_ = why;
  stopped_ = true;
}

}  // namespace machine
