#include "simulator/farm/kernel_cost.hpp"

#include <cmath>
#include <ctime>

#include "simulator/machine/process.hpp"

namespace farm {

double host_cpu_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

void KernelCost::charge(double host_s, std::span<const std::uint64_t> counts) {
  const auto cycles = cycles_per_host_s_
                          ? machine::Cycles{std::llround(host_s * *cycles_per_host_s_)}
                          : counted_(counts);
  host_s_ += host_s;
  charged_ += cycles;
  machine::this_process().charge(cycles);
}

}  // namespace farm
