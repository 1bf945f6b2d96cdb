#pragma once
// Common parts of the programs that use kernels of the renderer: memory of the program, sizes of
// records, and costs of kernel calls. A cost is either counted operations in cycles or scaled host
// time.
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

/// Allocates the memory of the program itself on a processor.
void load_program(machine::Processor& processor);

/// Starts a process named "PROCESSOR.NAME".
machine::Process& start(machine::Processor& on, const char* name, machine::Priority priority,
                        machine::Process::Body body);

/// Calls `body` while `bytes` of the current processor's memory are allocated.
template <class Body>
auto with_memory(std::uint64_t bytes, const char* what, Body body) {
  auto& self = machine::this_process();
  self.processor().memory().allocate(bytes, what, self.own_time());
  auto result = body();
  self.processor().memory().release(bytes);
  return result;
}

/// Sizes in bytes of the records of a ray, a hit and a pixel.
struct RecordBytes {
  std::uint32_t ray = 0, hit = 0, pixel = 0;
};
RecordBytes record_bytes(const machine::Model& model);

/// Costs of making a message and of reading one.
struct MessageCosts {
  machine::Cycles made, read;
};
MessageCosts message_costs(const machine::Model& model);

/// Size of a copy of the scene in bytes: objects and their hierarchy.
std::uint64_t scene_bytes(const machine::Model& model, const renderer::Scene& scene);
/// Size in bytes of the scene's texture pyramids, which every processor that shades must hold.
std::uint64_t texture_bytes(const machine::Model& model, const renderer::Scene& scene);

/// Makes a sentence for each kernel that was too short for the host's clock.
std::vector<std::string> note_short(const std::vector<KernelUse>& uses);

/// Cost of the calls of one kernel: cycles of its counted operations, or scaled host time. Several
/// processes may share a KernelCost.
class KernelCost {
 public:
  /// With `cycles_per_host_s`, charges host time instead of counts. With `profile`, also estimates
  /// the host time. Only a sample of short calls is measured, because reading the clock may take
  /// longer than a call.
  KernelCost(std::string name, ByModel<machine::OperationCosts> counted,
             std::optional<double> cycles_per_host_s, bool profile = false)
      : counted_(std::move(counted)), cycles_per_host_s_(cycles_per_host_s), profile_(profile) {
    if (cycles_per_host_s) timed_ = std::make_unique<Timed>();
    use_.name = std::move(name);
  }

  /// Calls `kernel`, which counts its operations in a renderer::Work, and charges this_process().
  /// With timed costs, copies of `kernel` are called again later. It must therefore have no side
  /// effects, and its inputs must still be valid then.
  template <class Kernel>
  auto operator()(Kernel kernel) {
    renderer::Work work;
    const auto start_s = begin_profile();
    auto result = kernel(work);
    if (start_s) note_profile(*start_s);
    charge(work, [&] { return make_replay(std::move(kernel)); });
    return result;
  }
  /// For a kernel that changes a state. Calls it with `state`; with timed costs, calls it again
  /// later with `scratch`, where it must do the same amount of work. Neither object may move.
  /// Returns the counts of operations.
  template <class State, class Kernel>
  renderer::Work operator()(State& state, State& scratch, Kernel kernel) {
    renderer::Work work;
    const auto start_s = begin_profile();
    kernel(state, work);
    if (start_s) note_profile(*start_s);
    charge(work, [&] { return make_replay(std::move(kernel), scratch); });
    return work;
  }

  /// For a kernel that may wait for data. Before each wait, the caller charges the operations
  /// counted so far, multiplied by the returned factor. With timed costs, this function calls
  /// `kernel` with all data present, so that there are no waits. Otherwise it returns 1 without
  /// calling `kernel`.
  template <class State, class Kernel>
  double eval_scale(State& scratch, Kernel kernel) {
    if (!timed_) return 1;
    renderer::Work work;
    kernel(scratch, work);
    const auto counted = counted_.here()(work.counts);
    const auto charged = eval(counted, [&] { return make_replay(std::move(kernel), scratch); });
    return static_cast<double>(charged.value) / static_cast<double>(counted.value);
  }

  /// Costs of operations on the processor of this_process().
  const machine::OperationCosts& counted() const { return counted_.here(); }
  machine::Cycles charged() const { return use_.charged; }   ///< total cycles charged for all calls
  machine::Seconds charged_s() const { return charged_s_; }  ///< duration of charged()
  double profile_s() const { return profile_s_; }            ///< estimated host time of all calls
  KernelUse use() const;

 private:
  // Allocated separately, because replays hold a reference to the counts while this object may
  // move.
  struct Timed {
    KernelTimer timer{this_host()};
    renderer::Work counts_of_replays;
  };

  template <class Kernel>
  auto make_replay(Kernel kernel) {
    return [kernel = std::move(kernel), &work = timed_->counts_of_replays] {
      const auto result = kernel(work);
      asm volatile("" : : "r"(&result) : "memory");  // prevents the compiler from removing the call
    };
  }
  template <class State, class Kernel>
  auto make_replay(Kernel kernel, State& scratch) {
    return [kernel = std::move(kernel), &scratch, &work = timed_->counts_of_replays] {
      kernel(scratch, work);
    };
  }
  // Calls `make` for the replay only if costs are timed.
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
  // Reads the clock if this call belongs to the sample.
  std::optional<double> begin_profile() const {
    const bool is_profiled = profile_ && use_.calls >= next_profiled_;
    return is_profiled ? std::optional(host_cpu_s()) : std::nullopt;
  }
  void note_profile(double start_s);

  ByModel<machine::OperationCosts> counted_;
  std::optional<double> cycles_per_host_s_;
  bool profile_;
  double profile_s_ = 0;
  std::uint64_t profiled_ = 0;       // number of calls covered by profile_s_
  std::uint64_t each_of_ = 1;        // sampling period in calls
  std::uint64_t next_profiled_ = 0;  // number of the next sampled call
  std::unique_ptr<Timed> timed_;     // set only if costs are timed
  KernelUse use_;
  machine::Seconds charged_s_{};
};

/// Use of those kernels that were called.
std::vector<KernelUse> uses_of(std::initializer_list<const KernelCost*> kernels);

/// Makes a kernel for KernelCost that renders a block of pixels.
inline auto block_kernel(const renderer::Scene& scene, const renderer::Params& params,
                         const renderer::Area& area) {
  return [&scene, &params, area](renderer::BlockBuffer& buffer, renderer::Work& work) {
    render_block(scene, params, area, buffer);
    work += buffer.block.work;
  };
}

/// Costs of intersections, and of whole shading trees. In trees, shading has the scale factor of
/// the central process, because that process shades if tasks are single rays.
machine::OperationCosts intersection_costs(const machine::Model& model);
machine::OperationCosts tree_costs(const machine::Model& model);
/// Costs of the central process: its computations and the display.
machine::OperationCosts central_costs(const machine::Model& model);
/// Cost of one operation of the coordinator or the display.
machine::Cycles central_cost(const machine::Model& model, std::string_view operation);

}  // namespace kernels
