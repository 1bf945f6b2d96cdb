#pragma once
// What a kernel's call costs its processor: its counted operations times their cycles, or the host
// time it took, scaled.
#include <optional>

#include "simulator/machine/model.hpp"

namespace farm {

// CPU time of this thread; s.
double host_cpu_s();

class KernelCost {
 public:
  // `cycles_per_host_s`: charge host time instead of counts. `profile`: measure it in any case.
  KernelCost(machine::OperationCosts counted, std::optional<double> cycles_per_host_s, bool profile)
      : counted_(std::move(counted)),
        cycles_per_host_s_(cycles_per_host_s),
        measures_(profile || cycles_per_host_s) {}

  // Calls `kernel`, which counts into `counts` what it does, and charges this_process().
  template <class Kernel>
  auto operator()(Kernel kernel, const auto& counts) {
    const double start_s = measures_ ? host_cpu_s() : 0;
    auto result = kernel();
    charge(measures_ ? host_cpu_s() - start_s : 0, counts);
    return result;
  }

  double host_s() const { return host_s_; }             // of all calls, if it was measured
  machine::Cycles charged() const { return charged_; }  // for all calls

 private:
  void charge(double host_s, std::span<const std::uint64_t> counts);

  machine::OperationCosts counted_;
  std::optional<double> cycles_per_host_s_;
  bool measures_;
  double host_s_ = 0;
  machine::Cycles charged_{};
};

}  // namespace farm
