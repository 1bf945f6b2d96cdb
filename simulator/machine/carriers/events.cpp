#include "simulator/machine/carriers/events.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <boost/heap/d_ary_heap.hpp>

#include "base/errors.hpp"

namespace machine {

namespace {

constexpr int PLACE_BITS = 24;  // allows 2^24 pending events
// Up to this number of pending events, a machine fits into the host's caches and needs no
// prefetching.
constexpr std::size_t FEW = 64;

__extension__ using Key = unsigned __int128;

std::atomic<bool> stop_requested = false;  // set by a signal handler

}  // namespace

// A pending event as one number, so that comparisons need no branches: its date, its order among
// events of the same date, and the index of its callback. The bits of non-negative dates sort like
// their values; adding 0.0 turns -0 into 0.
struct PendingEvent {
  Key key;
  PendingEvent(double date, std::uint64_t order, std::size_t place)
      : key(Key{std::bit_cast<std::uint64_t>(date + 0.0)} << 64 | order << PLACE_BITS | place) {}
  double date() const { return std::bit_cast<double>(static_cast<std::uint64_t>(key >> 64)); }
  std::uint64_t order() const { return static_cast<std::uint64_t>(key) >> PLACE_BITS; }
  std::size_t place() const {
    return static_cast<std::size_t>(key) & ((std::size_t{1} << PLACE_BITS) - 1);
  }
  // Reversed comparison, because the heap has the greatest element on top.
  bool operator<(const PendingEvent& o) const { return key > o.key; }
};

struct Events::Heap : boost::heap::d_ary_heap<PendingEvent, boost::heap::arity<4>> {};

Events::Events() : heap_(std::make_unique<Heap>()) {}
Events::~Events() = default;

void request_stop() { stop_requested = true; }

Callback* Events::ask(double date, std::uint64_t order) {
  if (order >> (64 - PLACE_BITS) != 0)
    throw base::InvariantBroken(fmt::format(
        "found {} events scheduled so far, expected fewer: order numbers are exhausted", order));
  if (free_.empty()) {
    if (callbacks_.size() >> PLACE_BITS != 0)
      throw base::InvariantBroken(
          fmt::format("found {} pending events, expected fewer", callbacks_.size()));
    free_.push_back(static_cast<std::uint32_t>(callbacks_.size()));
    callbacks_.emplace_back();
  }
  const std::uint32_t place = free_.back();
  free_.pop_back();
  heap_->emplace(date, order, place);
  next_ = std::min(next_, date);
  return &callbacks_[place];
}

Moment Events::next_moment() const {
  if (!soon_.empty()) return {now_};
  if (heap_->empty()) return {};
  return {next_, heap_->top().order()};
}

void Events::handle_next() {
  const PendingEvent event = heap_->top();
  heap_->pop();
  next_ = heap_->empty() ? NEVER : heap_->top().date();
  free_.push_back(static_cast<std::uint32_t>(event.place()));
  now_ = event.date();
  // Prefetches the processor that the next event concerns, because a large machine does not fit
  // into the host's near caches. On meshes of at least 8 x 8 processors this saves 8 % of the time.
  if (heap_->size() > FEW) callbacks_[heap_->top().place()].prefetch();
  handle(callbacks_[event.place()]);
}

void Events::handle(Callback callback) {
  if (now_ > until_) {
    now_ = until_;
    return stop(End::until);
  }
  if (stop_requested) return stop(End::requested);
  ++handled_;
  ignored_ = false;
  callback();
  if (!ignored_) last_useful_ = now_;
  finish();
}

void Events::finish() {
  for (std::size_t i = 0; i < soon_.size() && !stopped_; ++i) {
    Callback then = soon_[i];  // a copy, because the callback may itself call soon()
    then();
  }
  soon_.clear();
}

void Events::stop(End why) {
  if (!stopped_) end_ = why;
  stopped_ = true;
}

}  // namespace machine
