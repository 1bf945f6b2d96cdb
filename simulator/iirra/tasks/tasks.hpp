#pragma once
// Data of a worker's task manager (thesis, 5.1.3). Tasks are image cells. They are stored in a
// priority queue (BDI) or, if beyond the limits, in an unordered store (BDNI). Samples are stored
// separately.
#include <functional>
#include <unordered_map>
#include <vector>

#include "renderer/trace/adaptive.hpp"
#include "renderer/trace/render.hpp"
#include "simulator/iirra/tasks/realism.hpp"

namespace iirra {

using renderer::progressive::Point;

/// The image cell of a task.
struct TaskCell : SampledCell {
  /// Number of times that this cell, and the larger cells that contained it, have been painted. The
  /// display compares these numbers to find the newer of two paintings of a pixel.
  std::uint32_t paintings = 0;
  int sampled = 0;  ///< number of points of the next level that have already been sampled
};

/// A cell with its next step and importance, as found when the cell was stored.
struct Task {
  TaskCell cell;
  Quantities quantities = {};
  Advance next = Advance::sample;
  Importance importance = {};
  /// True if the task came from another processor and this one has not yet worked on it.
  bool has_just_come = false;
};

/// State of a sample point. A pixel may have several samples. They are taken one after another: the
/// next primary ray waits until the previous one has been traced.
struct Sample {
  renderer::Samples::Sums sums;
  std::vector<renderer::Ray> waiting;  ///< untraced rays of shading trees
  renderer::RayCounts rays;            ///< number of traced rays
  int begun = 0;                       ///< number of samples whose primary ray has been traced
  renderer::OpenPixel open;            ///< state of an incomplete pixel with adaptive sampling
};

/// A cell in transit to another processor, with its samples in the order of points_of().
struct MovedCell {
  TaskCell cell;
  std::vector<Sample> samples;
};

/// Numbers of operations of a task manager, with the names used in model files.
struct TaskWork {
  std::uint64_t heap_step = 0;       ///< exchanges of two tasks in the priority queue
  std::uint64_t record_stored = 0;   ///< tasks moved into or out of a store
  std::uint64_t ray_classified = 0;  ///< comparisons of a cell or waiting ray with the limits
  /// Comparisons of a sample with the minimum and maximum of its cell.
  std::uint64_t cell_judged = 0;
  static constexpr std::array<std::string_view, 4> NAMES = {"heap_step", "record_stored",
                                                            "ray_classified", "cell_judged"};
  std::array<std::uint64_t, 4> counts() const {
    return {heap_step, record_stored, ray_classified, cell_judged};
  }
};

class TaskStores {
 public:
  /// Adds a task to the priority queue, or to the unordered store if its next step exceeds the
  /// limits.
  void add(const Task& task, TaskWork& work);
  /// Removes and returns the most important task, or nothing if the priority queue is empty.
  std::optional<Task> take(TaskWork& work);
  /// Removes and returns a task that `may_go` accepts, or nothing. Searches only the last LOOKED_AT
  /// elements of the heap, so that the most important tasks stay.
  std::optional<Task> take_last(const std::function<bool(const Task&)>& may_go, TaskWork& work);
  /// Removes and returns all tasks, so that they can be compared with new limits.
  std::vector<Task> take_all();

  std::size_t active() const { return heap_.size(); }
  std::size_t parked() const { return later_.size(); }

 private:
  static constexpr std::size_t LOOKED_AT = 8;
  std::vector<Task> heap_, later_;
};

/// The samples of a processor, by position. Cells share samples, so that each is computed only once
/// per processor. Most samples stay until the end, because cells made by later divisions may need
/// them.
class SampleTable {
 public:
  SampleTable() = default;
  explicit SampleTable(const renderer::Sampling& sampling) : sampling_(sampling) {}

  /// The colour shown for a sample.
  renderer::Rgb colour_of(const Point& point) const {
    const Sample& sample = at(point);
    return eval_shown(sampling_, sample.sums, sample.begun);
  }
  /// Returns the sample at a point; makes an empty one if there is none.
  Sample& operator[](const Point& point) { return table_[key(point)]; }
  bool has(const Point& point) const { return table_.contains(key(point)); }
  Sample& at(const Point& point) { return table_.at(key(point)); }
  const Sample& at(const Point& point) const { return table_.at(key(point)); }
  void erase(const Point& point) { table_.erase(key(point)); }

 private:
  static std::uint64_t key(const Point& p) {
    return static_cast<std::uint64_t>(p.y) << 32 | static_cast<std::uint32_t>(p.x);
  }
  renderer::Sampling sampling_;
  std::unordered_map<std::uint64_t, Sample> table_;  // never iterated, so its order does not matter
};

/// Computes a cell's quantities from its samples. Considers only the waiting rays of
/// points_to_deepen().
Quantities find_quantities(const SampledCell& cell, const SampleTable& samples,
                           const Limits& limits, TaskWork& work);
/// Returns the samples whose shading trees must be traced for a cell. These are all samples of the
/// cell until every pixel of it is sampled, then only the pixels that no other cell owns.
renderer::progressive::Points points_to_deepen(const SampledCell& cell);
/// True if all pixels of the cell have their final colours.
bool is_finished(const SampledCell& cell, const SampleTable& samples);

}  // namespace iirra
