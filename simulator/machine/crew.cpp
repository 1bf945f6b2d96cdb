#include "simulator/machine/crew.hpp"

#include <utility>

namespace machine {

namespace {

// Number of times that a thread checks a value before it sleeps; takes some tens of microseconds.
// Waking a sleeping thread would take longer.
constexpr int TRIES = 2000;

}  // namespace

void WatchedNumber::add(std::int64_t difference) {
  {
    const std::lock_guard lock(lock_);
    value_.fetch_add(difference, std::memory_order_acq_rel);
  }
  changed_.notify_one();
}

void WatchedNumber::wait_while(std::int64_t old, bool may_spin) {
  for (int i = 0; may_spin && i < TRIES; ++i) {
    if (load() != old) return;
#ifdef __x86_64__
    __builtin_ia32_pause();
#endif
  }
  std::unique_lock lock(lock_);
  changed_.wait(lock, [&] { return load() != old; });
}

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
  for (Member& member : members_) member.called.add(1);
}

void Crew::work(const std::vector<std::size_t>& members) {
  bool is_first_called = false;
  for (const std::size_t number : members)
    if (number == 0)
      is_first_called = true;
    else
      at_work_.add(1);
  for (const std::size_t number : members)
    if (number != 0) members_[number].called.add(1);
  if (is_first_called) do_share(0);
  for (auto left = at_work_.load(); left != 0; left = at_work_.load())
    at_work_.wait_while(left, may_spin_);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void Crew::live(std::size_t number) {
  for (std::int64_t called = 0;; ++called) {
    members_[number].called.wait_while(called, may_spin_);
    if (is_over_) return;
    do_share(number);
    at_work_.add(-1);
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
