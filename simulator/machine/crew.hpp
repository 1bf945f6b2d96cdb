#pragma once
// Pool of threads that execute their shares of a task again and again. A barrier follows each
// repetition.
#include <atomic>
#include <cstdint>
#include <deque>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace machine {

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
    std::atomic<std::uint64_t> called{0};  // number of calls of work() for this member
    std::jthread thread;
  };
  void end();
  void live(std::size_t number);
  void do_share(std::size_t number);

  const Share share_;
  const bool may_spin_;
  // Number of members that are still working, not counting member 0.
  std::atomic<std::size_t> at_work_{0};
  std::atomic<bool> is_over_{false};
  std::mutex lock_;
  std::exception_ptr failure_;
  // Declared last, so that the threads end before the members that they use.
  std::deque<Member> members_;
};

}  // namespace machine
