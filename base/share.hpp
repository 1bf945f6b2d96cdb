#pragma once
// Work that host threads share.

#include <algorithm>
#include <atomic>
#include <future>
#include <vector>

namespace base {

/// Calls work(i) for every i from 0 below `count`; the threads are handed them one by one. After an
/// exception, which is thrown again, no more are handed out.
template <class Work>
void share(int count, int threads, const Work& work) {
  std::atomic<int> next = 0;
  const auto take_part = [&] {
    try {
      for (int i = next++; i < count; i = next++) work(i);
    } catch (...) {
      next = count;
      throw;
    }
  };
  std::vector<std::future<void>> helpers;
  for (int i = 1; i < std::min(threads, count); ++i)
    helpers.push_back(std::async(std::launch::async, take_part));
  take_part();
  for (auto& helper : helpers) helper.get();
}

}  // namespace base
