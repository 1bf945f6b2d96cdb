#pragma once
// A parallel loop on host threads.

#include <algorithm>
#include <atomic>
#include <future>
#include <vector>

namespace base {

/// Calls work(i) once for every i from 0 to `count` - 1, on `threads` threads. Each thread
/// repeatedly takes the next index. After an exception in `work`, no thread takes a further index,
/// and the exception is rethrown to the caller.
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
