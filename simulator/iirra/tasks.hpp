#pragma once
// What a task manager keeps (thesis, 5.1.3): its tasks, which are image cells, in an ordered store
// (BDI) and an unordered one (BDNI), and the samples that they are known by.
#include <functional>
#include <unordered_map>
#include <vector>

#include "renderer/trace/adaptive.hpp"
#include "renderer/trace/render.hpp"
#include "simulator/iirra/realism.hpp"

namespace iirra {

using renderer::progressive::Point;

/// A cell of a task.
struct TaskCell : SampledCell {
  /// How often it, or a cell that it is a part of, has been painted: of two pictures of a pixel the
  /// display knows which is newer.
  std::uint32_t paintings = 0;
  int sampled = 0;  ///< points of its next level, of which new limits have interrupted the sampling
};

/// A cell, and what was found when it was put into a store.
struct Task {
  TaskCell cell;
  Quantities quantities = {};
  Advance next = Advance::sample;
  Importance importance = {};
  bool has_just_come = false;  ///< from another processor: nothing has been done with it here
};

/// What is known of a place on the lattice. A pixel that has several samples has them one after the
/// other: the next one's primary ray waits when the one before has been traced.
struct Sample {
  renderer::Samples::Sums sums;
  std::vector<renderer::Ray> waiting;  ///< the rays of shading trees that were not traced yet
  renderer::RayCounts rays;            ///< those that were
  int begun = 0;                       ///< samples whose primary ray has been traced
  renderer::OpenPixel open;            ///< with adaptive sampling, until the last sample is there
};

/// A cell that goes to another processor, and its samples in the order of points_of().
struct MovedCell {
  TaskCell cell;
  std::vector<Sample> samples;
};

/// The operations of a task manager, with the names that model files use.
struct TaskWork {
  std::uint64_t heap_step = 0;       ///< an exchange of two tasks in the ordered store
  std::uint64_t record_stored = 0;   ///< a task moved into or out of a store
  std::uint64_t ray_classified = 0;  ///< a cell, or a ray that waits, compared with the limits
  std::uint64_t cell_judged = 0;     ///< a sample compared with its cell's least and greatest
  static constexpr std::array<std::string_view, 4> NAMES = {"heap_step", "record_stored",
                                                            "ray_classified", "cell_judged"};
  std::array<std::uint64_t, 4> counts() const {
    return {heap_step, record_stored, ray_classified, cell_judged};
  }
};

class TaskStores {
 public:
  /// Into the ordered store, unless nothing can be done with it within the limits.
  void add(const Task& task, TaskWork& work);
  /// The most important task; none if the ordered store is empty.
  std::optional<Task> take(TaskWork& work);
  /// A task of the ordered store that `may_go`, of the last few places of the heap: none of the
  /// most important.
  std::optional<Task> take_last(const std::function<bool(const Task&)>& may_go, TaskWork& work);
  /// All tasks, which are to be classified again: the stores are empty then.
  std::vector<Task> take_all();

  std::size_t active() const { return heap_.size(); }
  std::size_t parked() const { return later_.size(); }

 private:
  static constexpr std::size_t LOOKED_AT = 8;
  std::vector<Task> heap_, later_;
};

/// The samples of a processor, by their places. Each is computed once here, whatever cells share
/// it; most stay to the end, since a cell that comes to be by division may need them.
class SampleTable {
 public:
  SampleTable() = default;
  explicit SampleTable(const renderer::Sampling& sampling) : sampling_(sampling) {}

  /// What is shown of it.
  renderer::Rgb colour_of(const Point& point) const {
    const Sample& sample = at(point);
    return eval_shown(sampling_, sample.sums, sample.begun);
  }
  /// A new sample, or the one that is there.
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
  std::unordered_map<std::uint64_t, Sample> table_;  // never walked: its order means nothing
};

/// Finds the quantities of a cell from its samples. Rays that wait count at the samples of
/// points_to_deepen() alone.
Quantities find_quantities(const SampledCell& cell, const SampleTable& samples,
                           const Limits& limits, TaskWork& work);
/// The samples whose shading trees matter to a cell: all, or only its own pixels where every pixel
/// is sampled.
renderer::progressive::Points points_to_deepen(const SampledCell& cell);
/// Whether each of its pixels has the colour that it will keep.
bool is_finished(const SampledCell& cell, const SampleTable& samples);

}  // namespace iirra
