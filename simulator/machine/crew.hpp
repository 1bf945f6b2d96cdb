#pragma once
// Threads that do their shares of a work again and again, and wait for each other in between.
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
  /// `share` is called for members 0 to `size` - 1, each in a thread of its own: the first in that
  /// which calls work().
  Crew(std::size_t size, Share share);
  ~Crew() { end(); }

  /// The members given do their shares, all at the same time. Throws what one of them has thrown.
  void work(const std::vector<std::size_t>& members);

 private:
  struct alignas(64) Member {
    std::atomic<std::uint64_t> called{0};  // times
    std::jthread thread;
  };
  void end();
  void live(std::size_t number);
  void do_share(std::size_t number);

  const Share share_;
  const bool may_spin_;
  std::atomic<std::size_t> at_work_{0};  // others than the first
  std::atomic<bool> is_over_{false};
  std::mutex lock_;
  std::exception_ptr failure_;
  std::deque<Member> members_;  // the last: their threads end first
};

}  // namespace machine
