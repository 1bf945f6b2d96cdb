#pragma once
// What the programs that compute with the renderer's kernels share: the program's place on a
// processor, the sizes of the records that are stored and sent, and the cost of a kernel's call:
// its counted operations times their cycles, or the host time it takes, scaled.
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
/// Bytes of a copy of its textures' pictures in all their sizes, which who shades needs.
std::uint64_t texture_bytes(const machine::Model& model, const renderer::Scene& scene);

/// A sentence for each kernel that was too short for the host's clock.
std::vector<std::string> note_short(const std::vector<KernelUse>& uses);

/// What the calls of one kernel cost: their counted operations times their cycles, or the host time
/// they take, scaled. The processes that call it may share it.
class KernelCost {
 public:
  /// With `cycles_per_host_s` host time is charged instead of counts; with `profile` it is measured
  /// in any case, roughly: call by call, but of short calls only some, since to read the clock may
  /// take longer than a call.
  KernelCost(std::string name, ByModel<machine::OperationCosts> counted,
             std::optional<double> cycles_per_host_s, bool profile = false)
      : counted_(std::move(counted)), cycles_per_host_s_(cycles_per_host_s), profile_(profile) {
    if (cycles_per_host_s) timed_ = std::make_unique<Timed>();
    use_.name = std::move(name);
  }

  /// Calls `kernel`, which counts into a renderer::Work what it does, and charges this_process().
  /// Where costs are timed, copies of it are called again later: it changes nothing that matters,
  /// and holds its inputs, or references to what stays.
  template <class Kernel>
  auto operator()(Kernel kernel) {
    renderer::Work work;
    const auto start_s = begin_profile();
    auto result = kernel(work);
    if (start_s) note_profile(*start_s);
    charge(work, [&] { return make_replay(std::move(kernel)); });
    return result;
  }
  /// The same with a kernel that changes a state: calls it with `state`, later with `scratch`, on
  /// which it does as much. (Both stay where they are.) Returns what it counted.
  template <class State, class Kernel>
  renderer::Work operator()(State& state, State& scratch, Kernel kernel) {
    renderer::Work work;
    const auto start_s = begin_profile();
    kernel(state, work);
    if (start_s) note_profile(*start_s);
    charge(work, [&] { return make_replay(std::move(kernel), scratch); });
    return work;
  }

  /// For a kernel that waits for data now and then, and is charged its counts before: what they are
  /// to be multiplied by. Where costs are timed `kernel` is called as above to find it: it has all
  /// data here, and waits for none. Else 1, and it is not called.
  template <class State, class Kernel>
  double eval_scale(State& scratch, Kernel kernel) {
    if (!timed_) return 1;
    renderer::Work work;
    kernel(scratch, work);
    const auto counted = counted_.here()(work.counts);
    const auto charged = eval(counted, [&] { return make_replay(std::move(kernel), scratch); });
    return static_cast<double>(charged.value) / static_cast<double>(counted.value);
  }

  /// On the processor of this_process().
  const machine::OperationCosts& counted() const { return counted_.here(); }
  machine::Cycles charged() const { return use_.charged; }   ///< for all calls
  machine::Seconds charged_s() const { return charged_s_; }  ///< the same as time
  double profile_s() const { return profile_s_; }            ///< host time of all calls, about
  KernelUse use() const;

 private:
  // Where replays count; it stays when this moves.
  struct Timed {
    KernelTimer timer{this_host()};
    renderer::Work counts_of_replays;
  };

  template <class Kernel>
  auto make_replay(Kernel kernel) {
    return [kernel = std::move(kernel), &work = timed_->counts_of_replays] {
      const auto result = kernel(work);
      asm volatile("" : : "r"(&result) : "memory");  // or the compiler might leave it out
    };
  }
  template <class State, class Kernel>
  auto make_replay(Kernel kernel, State& scratch) {
    return [kernel = std::move(kernel), &scratch, &work = timed_->counts_of_replays] {
      kernel(scratch, work);
    };
  }
  // `make` makes the replay, where costs are timed.
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
  // The clock, if this call is to be measured.
  std::optional<double> begin_profile() const {
    const bool is_profiled = profile_ && use_.calls >= next_profiled_;
    return is_profiled ? std::optional(host_cpu_s()) : std::nullopt;
  }
  void note_profile(double start_s);

  ByModel<machine::OperationCosts> counted_;
  std::optional<double> cycles_per_host_s_;
  bool profile_;
  double profile_s_ = 0;
  std::uint64_t profiled_ = 0;       // calls that this is the time of
  std::uint64_t each_of_ = 1;        // one of so many calls is measured
  std::uint64_t next_profiled_ = 0;  // the number of the one that is measured next
  std::unique_ptr<Timed> timed_;     // where costs are timed
  KernelUse use_;
  machine::Seconds charged_s_{};
};

/// The use of those that were called.
std::vector<KernelUse> uses_of(std::initializer_list<const KernelCost*> kernels);

/// Renders a block of pixels, as a kernel for KernelCost.
inline auto block_kernel(const renderer::Scene& scene, const renderer::Params& params,
                         const renderer::Area& area) {
  return [&scene, &params, area](renderer::BlockBuffer& buffer, renderer::Work& work) {
    render_block(scene, params, area, buffer);
    work += buffer.block.work;
  };
}

/// Costs of finding intersections, and of a whole shading tree: its shading has the scale of the
/// centre, which shades where tasks are rays.
machine::OperationCosts intersection_costs(const machine::Model& model);
machine::OperationCosts tree_costs(const machine::Model& model);
/// Costs of what the centre computes, and displays.
machine::OperationCosts central_costs(const machine::Model& model);

}  // namespace kernels
