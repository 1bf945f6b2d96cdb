#include "simulator/machine/crew.hpp"

#include <utility>

namespace machine {

namespace {

// Number of times that a thread checks a value before it sleeps; takes some tens of microseconds.
// Waking a sleeping thread would take longer.
constexpr int TRIES = 2000;

// Waits until `value` differs from `old`: checks it repeatedly, then sleeps. If `may_spin` is
// false, sleeps at once, as in a pool with more threads than the host has processors.
template <class Value>
void wait_while(const std::atomic<Value>& value, Value old, bool may_spin) {
  for (int i = 0; may_spin && i < TRIES; ++i) {
    if (value.load(std::memory_order_acquire) != old) return;
#ifdef __x86_64__
    __builtin_ia32_pause();
#endif
  }
  value.wait(old, std::memory_order_acquire);
}

}  // namespace

Crew::Crew(std::size_t size, Share share)
    : share_(std::move(share)),
      may_spin_(size <= std::thread::hardware_concurrency()),
      members_(size) {
  try {
    for (std::size_t number = 1; number < size; ++number)
      members_[number].thread = std::jthread([this, number] { live(number); });
  } catch (...) {  // for instance, the host has no threads left
    end();
    throw;
  }
}

void Crew::end() {
  is_over_ = true;
  for (Member& member : members_) {
    ++member.called;
    member.called.notify_one();
  }
}

void Crew::work(const std::vector<std::size_t>& members) {
  bool is_first_called = false;
  for (const std::size_t number : members)
    if (number == 0)
      is_first_called = true;
    else
      at_work_.fetch_add(1, std::memory_order_relaxed);
  for (const std::size_t number : members)
    if (number != 0) {
      members_[number].called.fetch_add(1, std::memory_order_release);
      members_[number].called.notify_one();
    }
  if (is_first_called) do_share(0);
  for (std::size_t left = at_work_.load(std::memory_order_acquire); left != 0;
       left = at_work_.load(std::memory_order_acquire))
    wait_while(at_work_, left, may_spin_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Crew::live(std::size_t number) {
  for (std::uint64_t called = 0;; ++called) {
    wait_while(members_[number].called, called, may_spin_);
    if (is_over_) return;
    do_share(number);
    if (at_work_.fetch_sub(1, std::memory_order_acq_rel) == 1) at_work_.notify_one();
  }
}

void Crew::do_share(std::size_t number) {
  try {
    share_(number);
  } catch (...) {
    const std::lock_guard lock(lock_);
    if (!failure_) failure_ = std::current_exception();
  }
}

}  // namespace machine
