#include "simulator/machine/events.hpp"

#include <algorithm>
#include <csignal>
#include <functional>

namespace machine {

namespace {
volatile std::sig_atomic_t stop_requested = 0;
}

void request_stop() { stop_requested = 1; }

void Events::ask(double date, std::uint64_t order, Callback callback) {
  heap_.push_back({date, order, callback});
  std::ranges::push_heap(heap_, std::less<>());
}

void Events::handle_next() {
  std::ranges::pop_heap(heap_, std::less<>());
  const Event event = heap_.back();
  heap_.pop_back();
  now_ = event.date;
  handle(event.callback);
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
