#include "simulator/machine/crew.hpp"

#include <utility>

namespace machine {

namespace {

// Some microseconds: a thread that sleeps takes longer than that to wake up.
constexpr int TRIES = 4000;

// Until `value` is not `old` any more. It sleeps only if that takes long, or if there are more
// threads than the host has processors.
template <class Value>
void wait_while(const std::atomic<Value>& value, Value old, bool may_spin) {
  for (int i = 0; may_spin && i < TRIES; ++i) {
    if (value.load(std::memory_order_acquire) != old) return;
    __builtin_ia32_pause();
  }
  value.wait(old, std::memory_order_acquire);
}

}  // namespace

Crew::Crew(std::size_t size, std::function<void(std::size_t)> share)
    : share_(std::move(share)), may_spin_(size <= std::thread::hardware_concurrency()) {
  for (std::size_t number = 1; number < size; ++number)
    threads_.emplace_back([this, number] { live(number); });
}

Crew::~Crew() {
  is_over_ = true;
  ++round_;
  round_.notify_all();
}

void Crew::work() {
  at_work_.store(threads_.size(), std::memory_order_relaxed);
  round_.fetch_add(1, std::memory_order_release);
  round_.notify_all();
  do_share(0);
  for (std::size_t left = at_work_.load(std::memory_order_acquire); left != 0;
       left = at_work_.load(std::memory_order_acquire))
    wait_while(at_work_, left, may_spin_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Crew::live(std::size_t number) {
  for (std::uint64_t round = 0;; ++round) {
    wait_while(round_, round, may_spin_);
    if (is_over_) return;
    do_share(number);
    at_work_.fetch_sub(1, std::memory_order_release);
    at_work_.notify_one();
  }
}

void Crew::do_share(std::size_t number) {
  try {
    share_(number);
  } catch (...) {
    const std::lock_guard lock(mutex_);
    if (!failure_) failure_ = std::current_exception();
  }
}

}  // namespace machine
