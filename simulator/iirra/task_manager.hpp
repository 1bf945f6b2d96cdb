#pragma once
// The task manager of a worker (TM; thesis, 5.1.3): its tasks within and beyond the limits, and
// their moves to and from other workers.
#include "simulator/iirra/frame_buffers.hpp"
#include "simulator/iirra/sampler.hpp"

namespace iirra {

/// Charges its work and allocates its memory on the processor of this_process().
class TaskManager {
 public:
  TaskManager(Shared& shared, Sampler& sampler, FrameBuffers& unshown);

  /// Removes and returns the most important task; none if no task is within the limits.
  std::optional<Task> take();
  /// Stores a cell as a task. If the colours of its pixels are final, records them instead.
  void put(const TaskCell& cell, bool has_just_come = false);
  /// Classifies all tasks again by the limits of a new phase. Returns false for an old phase.
  bool begin_phase(const NewPhase& phase);
  /// Removes and returns tasks for another worker; none if there are none to spare.
  std::optional<Tasks> share();
  /// Stores a cell from another processor. `is_first`: the sender is the coordinator.
  void receive(const MovedCell& moved, bool is_first);
  /// The pixels parked and finished since the last report; none while tasks are within the limits.
  std::optional<Report> report();

  std::size_t active() const { return stores_.active(); }  ///< tasks within the limits
  std::uint64_t pixels_of(const SampledCell& cell) const;  ///< only those in the computed area
  std::uint32_t phase() const { return phase_; }
  int order() const { return order_; }  ///< number of the user's order that set the limits
  const Limits& limits() const { return limits_; }

 private:
  void finish(TaskCell cell);
  MovedCell pack(const TaskCell& cell);
  void charge_work();

  Shared& shared_;
  const Params& params_;
  const Sizes& sizes_;
  Counts& counts_;
  const Ordering ordering_;
  Sampler& sampler_;
  SampleTable& samples_;
  FrameBuffers& unshown_;
  TaskStores stores_;
  TaskWork work_;
  Limits limits_;
  std::uint32_t phase_ = 0;
  int order_ = 0;
  std::uint64_t finished_ = 0;                       // pixels
  std::uint64_t new_parked_ = 0, new_finished_ = 0;  // pixels not yet reported in this phase
};

}  // namespace iirra
