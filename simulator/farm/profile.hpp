#pragma once
// Host time spent in the kernels, measured only where asked for: it never enters a result.
#include <chrono>

namespace farm {

struct KernelProfile {
  bool enabled = false;
  double kernel_s = 0;  // host seconds in kernels

  template <class Call>
  auto operator()(Call call) {
    if (!enabled) return call();
    const auto start = std::chrono::steady_clock::now();
    auto result = call();
    kernel_s += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return result;
  }
};

}  // namespace farm
