#pragma once
// The task manager of a worker (TM; thesis, 5.1.3). It holds the worker's tasks (image cells), both
// within and beyond the limits, and exchanges tasks with other workers.
#include "simulator/iirra/frame_buffers.hpp"
#include "simulator/iirra/sampler.hpp"

namespace iirra {

/// All functions charge time and allocate memory on the processor of this_process().
class TaskManager {
 public:
  TaskManager(Shared& shared, Sampler& sampler, FrameBuffers& unshown);

  /// Removes and returns the most important task, or nothing if no task is within the limits.
  std::optional<Task> take();
  /// Stores a cell as a task. If its pixels have their final colours, records these instead.
  void put(const TaskCell& cell, bool has_just_come = false);
  /// Compares all tasks with the limits of a new phase. Returns false, without effect, unless the
  /// phase is newer than the present one.
  bool begin_phase(const NewPhase& phase);
  /// Removes and returns tasks for another worker, or nothing if this worker has none to spare.
  std::optional<Tasks> share();
  /// Stores a cell from another processor. `is_first` is true if the coordinator sent it.
  void receive(const MovedCell& moved, bool is_first);
  /// Returns the numbers of pixels that came to wait beyond the limits, or were finished, since the
  /// last report. Returns nothing while tasks are within the limits, or if both numbers are 0.
  std::optional<Report> report();

  std::size_t active() const { return stores_.active(); }  ///< number of tasks within the limits
  /// Number of the cell's pixels that lie in the computed area.
  std::uint64_t pixels_of(const SampledCell& cell) const;
  std::uint32_t phase() const { return phase_; }
  /// Number of the user's order that set the limits, 0 if none.
  int order() const { return order_; }
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
  std::uint64_t finished_ = 0;  // number of finished pixels
  // Numbers of pixels of this phase that have not yet been reported.
  std::uint64_t new_parked_ = 0, new_finished_ = 0;
};

}  // namespace iirra
