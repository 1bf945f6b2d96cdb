#pragma once
// Pool of threads that execute their shares of a task again and again. A barrier follows each
// repetition.
#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace machine {

/// A number whose change threads can wait for. A waiting thread sleeps without using the CPU. A
/// thread in std::atomic::wait() may first give up the CPU several times with sched_yield(), each
/// time behind every other thread of a busy host.
class WatchedNumber {
 public:
  /// Adds `difference` and wakes one waiting thread.
  void add(std::int64_t difference);
  [[nodiscard]] std::int64_t load() const { return value_.load(std::memory_order_acquire); }
  /// Waits until the number differs from `old`. If `may_spin` is true, checks the number repeatedly
  /// for some tens of microseconds before the thread sleeps.
  void wait_while(std::int64_t old, bool may_spin);

 private:
  std::atomic<std::int64_t> value_{0};
  std::mutex lock_;
  std::condition_variable changed_;
};

class Crew {
 public:
  using Share = std::function<void(std::size_t number)>;
  /// Makes a pool with members 0 to `size` - 1. Each member executes `share` with its number.
  /// Member 0 runs in the thread that calls work(); each other member has a thread of its own.
  Crew(std::size_t size, Share share);
  ~Crew() { end(); }

  /// Executes the shares of the given members in parallel and returns when all are done. Rethrows
  /// the first exception.
  void work(const std::vector<std::size_t>& members);

 private:
  struct alignas(64) Member {
    WatchedNumber called;  // number of calls of work() for this member
    std::jthread thread;
  };
  void end();
  void live(std::size_t number);
  void do_share(std::size_t number);

  const Share share_;
  const bool may_spin_;
  // Number of members that are still working, not counting member 0.
  WatchedNumber at_work_;
  std::atomic<bool> is_over_{false};
  std::mutex lock_;
  std::exception_ptr failure_;
  // Declared last, so that the threads end before the members that they use.
  std::deque<Member> members_;
};

}  // namespace machine
