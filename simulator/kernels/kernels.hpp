#pragma once
// Common part of the programs that use the renderer's kernels: the program's memory on a processor,
// the sizes of records, and the cost of a kernel's call. The cost is either the counted operations
// times their cycles, or the scaled host time.
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "renderer/trace/render.hpp"
#include "simulator/kernels/by_model.hpp"
#include "simulator/kernels/kernel_timer.hpp"
#include "simulator/machine/machine.hpp"
#include "simulator/observe/use.hpp"

namespace kernels {

using observe::KernelUse;

/// Allocates the program's part of a processor's memory.
void load_program(machine::Processor& processor);

/// Starts a process called "processor.name".
void start(machine::Processor& on, const char* name, machine::Priority priority,
           machine::Process::Body body);

/// Calls `body` with `bytes` of the current processor's memory allocated.
template <class Body>
auto with_memory(std::uint64_t bytes, const char* what, Body body) {
  auto& self = machine::this_process();
  self.processor().memory().allocate(bytes, what, self.own_time());
  auto result = body();
  self.processor().memory().release(bytes);
  return result;
}

/// Sizes of the records of a ray, of its hit and of a pixel, in bytes.
struct RecordBytes {
  std::uint32_t ray = 0, hit = 0, pixel = 0;
};
RecordBytes record_bytes(const machine::Model& model);

/// Costs of a process for making a message and for reading one.
struct MessageCosts {
  machine::Cycles made, read;
};
MessageCosts message_costs(const machine::Model& model);

/// Bytes of a copy of the scene: its objects and their hierarchy.
std::uint64_t scene_bytes(const machine::Model& model, const renderer::Scene& scene);
/// Bytes of a copy of its texture pyramids, needed by every processor that shades.
std::uint64_t texture_bytes(const machine::Model& model, const renderer::Scene& scene);

/// A sentence for each kernel that was too short for the host's clock.
std::vector<std::string> note_short(const std::vector<KernelUse>& uses);

/// Cost of the calls of one kernel: counted operations times their cycles, or scaled host time.
/// Several processes may share it.
class KernelCost {
 public:
  /// With `cycles_per_host_s`, charges host time instead of counts. With `profile`, also measures
  /// the host time roughly, call by call; only a sample of short calls, because reading the clock
  /// may take longer than a call.
  KernelCost(std::string name, ByModel<machine::OperationCosts> counted,
             std::optional<double> cycles_per_host_s, bool profile = false)
      : counted_(std::move(counted)), cycles_per_host_s_(cycles_per_host_s), profile_(profile) {
    if (cycles_per_host_s) timed_ = std::make_unique<Timed>();
    use_.name = std::move(name);
  }

  /// Calls `kernel`, which counts its operations in a renderer::Work, and charges this_process().
  /// With timed costs, copies of `kernel` are called again later. It must therefore have no side
  /// effects, and hold its inputs or references to lasting data.
  template <class Kernel>
  auto operator()(Kernel kernel) {
    renderer::Work work;
    const auto start_s = begin_profile();
    auto result = kernel(work);
    if (start_s) note_profile(*start_s);
    charge(work, [&] { return make_replay(std::move(kernel)); });
    return result;
  }
  /// The same for a kernel that changes a state: called first with `state`, later with `scratch`,
  /// with the same amount of work. (Neither may move.) Returns its counts.
  template <class State, class Kernel>
  renderer::Work operator()(State& state, State& scratch, Kernel kernel) {
    renderer::Work work;
    const auto start_s = begin_profile();
    kernel(state, work);
    if (start_s) note_profile(*start_s);
    charge(work, [&] { return make_replay(std::move(kernel), scratch); });
    return work;
  }

  /// Factor for the counts of a kernel that sometimes waits for data and is charged its counts
  /// before each wait. With timed costs, calls `kernel` as above; here it has all data and never
  /// waits. Else returns 1 without a call.
  template <class State, class Kernel>
  double eval_scale(State& scratch, Kernel kernel) {
    if (!timed_) return 1;
    renderer::Work work;
    kernel(scratch, work);
    const auto counted = counted_.here()(work.counts);
    const auto charged = eval(counted, [&] { return make_replay(std::move(kernel), scratch); });
    return static_cast<double>(charged.value) / static_cast<double>(counted.value);
  }

  /// Costs on the processor of this_process().
  const machine::OperationCosts& counted() const { return counted_.here(); }
  machine::Cycles charged() const { return use_.charged; }   ///< for all calls
  machine::Seconds charged_s() const { return charged_s_; }  ///< the same as time
  double profile_s() const { return profile_s_; }            ///< estimated host time of all calls
  KernelUse use() const;

 private:
  // On the heap, so that the counter of the replays does not move with this object.
  struct Timed {
    KernelTimer timer{this_host()};
    renderer::Work counts_of_replays;
  };

  template <class Kernel>
  auto make_replay(Kernel kernel) {
    return [kernel = std::move(kernel), &work = timed_->counts_of_replays] {
      const auto result = kernel(work);
      asm volatile("" : : "r"(&result) : "memory");  // else the compiler may drop the call
    };
  }
  template <class State, class Kernel>
  auto make_replay(Kernel kernel, State& scratch) {
    return [kernel = std::move(kernel), &scratch, &work = timed_->counts_of_replays] {
      kernel(scratch, work);
    };
  }
  // `make` makes the replay, for timed costs.
  template <class Make>
  machine::Cycles eval(machine::Cycles counted, Make make) {
    if (!timed_) return note(counted, counted, 0);
    const double weight = std::max(1.0, static_cast<double>(counted.value));
    const double host_s = timed_->timer.eval(make(), weight);
    return note(counted, {std::llround(host_s * *cycles_per_host_s_)}, host_s);
  }
  machine::Cycles note(machine::Cycles counted, machine::Cycles charged, double host_s);
  template <class Make>
  void charge(const renderer::Work& work, Make make) {
    machine::this_process().charge(eval(counted_.here()(work.counts), std::move(make)));
  }
  // Time of the clock if this call is in the sample.
  std::optional<double> begin_profile() const {
    const bool is_profiled = profile_ && use_.calls >= next_profiled_;
    return is_profiled ? std::optional(host_cpu_s()) : std::nullopt;
  }
  void note_profile(double start_s);

  ByModel<machine::OperationCosts> counted_;
  std::optional<double> cycles_per_host_s_;
  bool profile_;
  double profile_s_ = 0;
  std::uint64_t profiled_ = 0;       // calls covered by profile_s_
  std::uint64_t each_of_ = 1;        // sampling period in calls
  std::uint64_t next_profiled_ = 0;  // number of the next sampled call
  std::unique_ptr<Timed> timed_;     // only for timed costs
  KernelUse use_;
  machine::Seconds charged_s_{};
};

/// Use of the kernels that were called.
std::vector<KernelUse> uses_of(std::initializer_list<const KernelCost*> kernels);

/// Renders a block of pixels, as a kernel for KernelCost.
inline auto block_kernel(const renderer::Scene& scene, const renderer::Params& params,
                         const renderer::Area& area) {
  return [&scene, &params, area](renderer::BlockBuffer& buffer, renderer::Work& work) {
    render_block(scene, params, area, buffer);
    work += buffer.block.work;
  };
}

/// Costs of intersections, and of a whole shading tree. Shading in a tree has the scale of the
/// central process, which shades if tasks are rays.
machine::OperationCosts intersection_costs(const machine::Model& model);
machine::OperationCosts tree_costs(const machine::Model& model);
/// Costs of the central process's computations and display.
machine::OperationCosts central_costs(const machine::Model& model);

}  // namespace kernels
