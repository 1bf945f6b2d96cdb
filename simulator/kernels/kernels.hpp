#pragma once
// Parts shared by the programs that call kernels (numerical functions) of the renderer: memory of
// the program, sizes of records, and costs of kernel calls. A cost is either the cycles of counted
// operations or the scaled host time.
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

/// Allocates the memory that the program itself (its code) needs on a processor.
void load_program(machine::Processor& processor);

/// Starts a process named "PROCESSOR.NAME".
machine::Process& start(machine::Processor& on, const char* name, machine::Priority priority,
                        machine::Process::Body body);

/// Allocates `bytes` of the current processor's memory, calls `body`, and releases the memory.
/// Returns the result of `body`. If too little memory is left, the error names `what`.
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

/// Size in bytes of one copy of the scene: its objects and their bounding hierarchy.
std::uint64_t scene_bytes(const machine::Model& model, const renderer::Scene& scene);
/// Size in bytes of the scene's texture pyramids. Every processor that shades must hold them.
std::uint64_t texture_bytes(const machine::Model& model, const renderer::Scene& scene);

/// Returns a sentence for each kernel that was too short to be measured with the host's clock.
std::vector<std::string> note_short(const std::vector<KernelUse>& uses);

/// Cost of the calls of one kernel: the cycles of its counted operations, or the scaled host time.
/// Several processes may share a KernelCost.
class KernelCost {
 public:
  /// If `cycles_per_host_s` is set, charges host time, converted with this factor, instead of
  /// counted operations. If `profile` is true, also estimates the host time of all calls. For this
  /// estimate only some of the short calls are measured, because reading the clock may take longer
  /// than a call.
  KernelCost(std::string name, ByModel<machine::OperationCosts> counted,
             std::optional<double> cycles_per_host_s, bool profile = false)
      : counted_(std::move(counted)), cycles_per_host_s_(cycles_per_host_s), profile_(profile) {
    if (cycles_per_host_s) timed_ = std::make_unique<Timed>();
    use_.name = std::move(name);
  }

  /// Calls `kernel`, which adds its operations to a renderer::Work, and charges the cost to
  /// this_process(). If costs are host times, copies of `kernel` are called again later. `kernel`
  /// must therefore have no side effects, and its inputs must stay valid.
  template <class Kernel>
  auto operator()(Kernel kernel) {
    renderer::Work work;
    const auto start_s = begin_profile();
    auto result = kernel(work);
    if (start_s) note_profile(*start_s);
    charge(work, [&] { return make_replay(std::move(kernel)); });
    return result;
  }
  /// For a kernel that changes an object: calls it with `state`. If costs are host times, calls it
  /// again later with `scratch`, where it must do the same amount of work. Neither object may move.
  /// Returns the numbers of operations.
  template <class State, class Kernel>
  renderer::Work operator()(State& state, State& scratch, Kernel kernel) {
    renderer::Work work;
    const auto start_s = begin_profile();
    kernel(state, work);
    if (start_s) note_profile(*start_s);
    charge(work, [&] { return make_replay(std::move(kernel), scratch); });
    return work;
  }

  /// For a kernel that may wait for data. The caller itself charges the counted operations before
  /// each wait, multiplied by the factor that this function returns. If costs are host times, calls
  /// `kernel` with all data present, hence without waits, to find the factor. Otherwise returns 1
  /// without calling `kernel`.
  template <class State, class Kernel>
  double eval_scale(State& scratch, Kernel kernel) {
    if (!timed_) return 1;
    renderer::Work work;
    kernel(scratch, work);
    const auto counted = counted_.here()(work.counts);
    const auto charged = eval(counted, [&] { return make_replay(std::move(kernel), scratch); });
    return static_cast<double>(charged.value) / static_cast<double>(counted.value);
  }

  /// Cycles of each operation on the processor of this_process().
  const machine::OperationCosts& counted() const { return counted_.here(); }
  machine::Cycles charged() const { return use_.charged; }   ///< total cycles charged for all calls
  machine::Seconds charged_s() const { return charged_s_; }  ///< duration of charged()
  double profile_s() const { return profile_s_; }            ///< estimated host time of all calls
  KernelUse use() const;

 private:
  // Allocated separately, so that its address stays the same when this object moves. Replays, which
  // repeat a call to time it, keep a reference to the counts.
  struct Timed {
    KernelTimer timer{this_host()};
    renderer::Work counts_of_replays;
  };

  template <class Kernel>
  auto make_replay(Kernel kernel) {
    return [kernel = std::move(kernel), &work = timed_->counts_of_replays] {
      const auto result = kernel(work);
      asm volatile("" : : "r"(&result) : "memory");  // keeps the compiler from removing the call
    };
  }
  template <class State, class Kernel>
  auto make_replay(Kernel kernel, State& scratch) {
    return [kernel = std::move(kernel), &scratch, &work = timed_->counts_of_replays] {
      kernel(scratch, work);
    };
  }
  // Calls `make`, which returns the replay of a call, only if costs are host times.
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
  // Reads the clock if this call is one of those that are measured for the profile.
  std::optional<double> begin_profile() const {
    const bool is_profiled = profile_ && use_.calls >= next_profiled_;
    return is_profiled ? std::optional(host_cpu_s()) : std::nullopt;
  }
  void note_profile(double start_s);

  ByModel<machine::OperationCosts> counted_;
  std::optional<double> cycles_per_host_s_;
  bool profile_;
  double profile_s_ = 0;
  std::uint64_t profiled_ = 0;       // number of calls that profile_s_ stands for
  std::uint64_t each_of_ = 1;        // one in so many calls is measured
  std::uint64_t next_profiled_ = 0;  // number of the next call to be measured
  std::unique_ptr<Timed> timed_;     // only if costs are host times
  KernelUse use_;
  machine::Seconds charged_s_{};
};

/// Use of the given kernels, without those that were never called.
std::vector<KernelUse> uses_of(std::initializer_list<const KernelCost*> kernels);

/// Makes a function for KernelCost that renders a block of pixels.
inline auto block_kernel(const renderer::Scene& scene, const renderer::Params& params,
                         const renderer::Area& area) {
  return [&scene, &params, area](renderer::BlockBuffer& buffer, renderer::Work& work) {
    render_block(scene, params, area, buffer);
    work += buffer.block.work;
  };
}

/// Costs of finding intersections, and of tracing whole shading trees. Shading inside a tree costs
/// as much as in the central process, which shades if tasks are single rays.
machine::OperationCosts intersection_costs(const machine::Model& model);
machine::OperationCosts tree_costs(const machine::Model& model);
/// Costs of operations in the central process: computations and display.
machine::OperationCosts central_costs(const machine::Model& model);
/// Cost of one operation of the coordinator or the display.
machine::Cycles central_cost(const machine::Model& model, std::string_view operation);

}  // namespace kernels
