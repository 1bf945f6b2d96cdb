#pragma once
// Threads that do the same work, each its share, again and again, and wait for each other between.
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace machine {

class Crew {
 public:
  /// `size` > 0, the thread that calls work() included; `share` is called with 0 to size - 1.
  Crew(std::size_t size, std::function<void(std::size_t)> share);
  ~Crew();

  /// Does all shares, the first in this thread, the others always in the same thread. Throws what a
  /// share has thrown first.
  void work();

 private:
  void live(std::size_t number);
  void do_share(std::size_t number);

  const std::function<void(std::size_t)> share_;
  const bool may_spin_;
  std::atomic<std::uint64_t> round_{0};
  std::atomic<std::size_t> at_work_{0};
  std::atomic<bool> is_over_{false};
  std::mutex mutex_;
  std::exception_ptr failure_;
  std::vector<std::jthread> threads_;  // the last: they are joined first
};

}  // namespace machine
