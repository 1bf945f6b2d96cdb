#pragma once
// What the programs that compute with the renderer's kernels share: the program's place on a
// processor, the sizes of the records that are stored and sent, and the cost of a kernel's call:
// its counted operations times their cycles, or the host time it took, scaled.
#include <optional>

#include "renderer/scene/scene.hpp"
#include "renderer/scene/work.hpp"
#include "simulator/machine/machine.hpp"

namespace kernels {

/// Takes the program's part of a processor's memory.
void load_program(machine::Processor& processor);

/// Starts a process called "processor.name".
void start(machine::Processor& on, const char* name, machine::Priority priority,
           machine::Process::Body body);

/// Calls `body` with so many bytes of this process's processor's memory taken.
template <class Body>
auto with_memory(std::uint64_t bytes, const char* what, Body body) {
  auto& self = machine::this_process();
  self.processor().memory().allocate(bytes, what, self.own_time());
  auto result = body();
  self.processor().memory().release(bytes);
  return result;
}

/// Sizes of a ray, of what it hits and of a pixel, in bytes.
struct RecordBytes {
  std::uint32_t ray = 0, hit = 0, pixel = 0;
};
RecordBytes record_bytes(const machine::Model& model);

/// What a process does around a message: it writes what the message is, or looks at what it is.
struct MessageCosts {
  machine::Cycles made, read;
};
MessageCosts message_costs(const machine::Model& model);

/// Bytes of a copy of the scene: its objects and their hierarchy.
std::uint64_t scene_bytes(const machine::Model& model, const renderer::Scene& scene);

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

  double host_s() const { return host_s_; }  ///< host time of all calls, if it was measured
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
