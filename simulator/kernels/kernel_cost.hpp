#pragma once
// The cost of a kernel's call on its processor: its counted operations times their cycles, or the
// host time it took, scaled.
#include <optional>

#include "renderer/scene/work.hpp"
#include "simulator/machine/model.hpp"

namespace kernels {

/// CPU time of this thread, s.
double host_cpu_s();

class KernelCost {
 public:
  /// With `cycles_per_host_s` host time is charged instead of counts; with `profile` it is measured
  /// in any case.
  KernelCost(machine::OperationCosts counted, std::optional<double> cycles_per_host_s, bool profile)
      : counted_(std::move(counted)),
        cycles_per_host_s_(cycles_per_host_s),
        measures_(profile || cycles_per_host_s) {}

  /// Calls `kernel`, which counts into `work` what it does, and charges this_process().
  template <class Kernel>
  auto operator()(Kernel kernel, const renderer::Work& work) {
    const double start_s = measures_ ? host_cpu_s() : 0;
    auto result = kernel();
    charge(measures_ ? host_cpu_s() - start_s : 0, work);
    return result;
  }

  double host_s() const { return host_s_; }             ///< of all calls, if it was measured
  machine::Cycles charged() const { return charged_; }  ///< for all calls

 private:
  void charge(double host_s, const renderer::Work& work);

  machine::OperationCosts counted_;
  std::optional<double> cycles_per_host_s_;
  bool measures_;
  double host_s_ = 0;
  machine::Cycles charged_{};
};

/// Costs of finding intersections, and of a whole shading tree: its shading has the scale of the
/// centre, which shades where tasks are rays.
machine::OperationCosts intersection_costs(const machine::Model& model);
machine::OperationCosts tree_costs(const machine::Model& model);

}  // namespace kernels
