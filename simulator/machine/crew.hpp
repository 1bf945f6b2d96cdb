#pragma once
// Pool of threads that repeatedly execute their shares of a task, with a barrier after each
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
  /// Makes a pool whose members 0 to `size` - 1 execute `share`. Member 0 runs in the thread that
  /// calls work(); each other member has its own thread.
  Crew(std::size_t size, Share share);
  ~Crew() { end(); }

  /// Executes the shares of the given members in parallel. Rethrows the first exception.
  void work(const std::vector<std::size_t>& members);

 private:
  struct alignas(64) Member {
    std::atomic<std::uint64_t> called{0};  // number of calls of work()
    std::jthread thread;
  };
  void end();
  void live(std::size_t number);
  void do_share(std::size_t number);

  const Share share_;
  const bool may_spin_;
  std::atomic<std::size_t> at_work_{0};  // active members other than member 0
  std::atomic<bool> is_over_{false};
  std::mutex lock_;
  std::exception_ptr failure_;
  std::deque<Member> members_;  // last, so that threads end before other members
};

}  // namespace machine
