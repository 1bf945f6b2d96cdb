#pragma once
// Data of a task manager (thesis, 5.1.3): its tasks, which are image cells, in an ordered store
// (BDI) and an unordered one (BDNI), and their samples.
#include <functional>
#include <unordered_map>
#include <vector>

#include "renderer/trace/adaptive.hpp"
#include "renderer/trace/render.hpp"
#include "simulator/iirra/realism.hpp"

namespace iirra {

using renderer::progressive::Point;

/// The cell of a task.
struct TaskCell : SampledCell {
  /// Paintings of this cell and of the cells that it came from. The display compares them to find
  /// the newer of two pictures of a pixel.
  std::uint32_t paintings = 0;
  int sampled = 0;  ///< sampled points of the next level, if new limits interrupted it
};

/// A cell, with its assessment when it was stored.
struct Task {
  TaskCell cell;
  Quantities quantities = {};
  Advance next = Advance::sample;
  Importance importance = {};
  bool has_just_come = false;  ///< from another processor, and not yet worked on here
};

/// State of a lattice point. Several samples of a pixel are taken one after another: the next
/// primary ray waits until the last one is traced.
struct Sample {
  renderer::Samples::Sums sums;
  std::vector<renderer::Ray> waiting;  ///< untraced rays of shading trees
  renderer::RayCounts rays;            ///< traced rays
  int begun = 0;                       ///< samples with a traced primary ray
  renderer::OpenPixel open;            ///< adaptive sampling: until the last sample is complete
};

/// A cell on its way to another processor, with its samples in the order of points_of().
struct MovedCell {
  TaskCell cell;
  std::vector<Sample> samples;
};

/// Operations of a task manager, named as in model files.
struct TaskWork {
  std::uint64_t heap_step = 0;       ///< an exchange of two tasks in the ordered store
  std::uint64_t record_stored = 0;   ///< a task moved into or out of a store
  std::uint64_t ray_classified = 0;  ///< a cell or a waiting ray compared with the limits
  std::uint64_t cell_judged = 0;     ///< a sample compared with its cell's minimum and maximum
  static constexpr std::array<std::string_view, 4> NAMES = {"heap_step", "record_stored",
                                                            "ray_classified", "cell_judged"};
  std::array<std::uint64_t, 4> counts() const {
    return {heap_step, record_stored, ray_classified, cell_judged};
  }
};

class TaskStores {
 public:
  /// Adds to the ordered store; to the other if no step is within the limits.
  void add(const Task& task, TaskWork& work);
  /// The most important task; none if the ordered store is empty.
  std::optional<Task> take(TaskWork& work);
  /// Takes a task that `may_go` accepts from the last places of the heap, so none of the most
  /// important.
  std::optional<Task> take_last(const std::function<bool(const Task&)>& may_go, TaskWork& work);
  /// Removes and returns all tasks, for reclassification.
  std::vector<Task> take_all();

  std::size_t active() const { return heap_.size(); }
  std::size_t parked() const { return later_.size(); }

 private:
  static constexpr std::size_t LOOKED_AT = 8;
  std::vector<Task> heap_, later_;
};

/// Samples of a processor, by position. Cells share them: each is computed once per processor. Most
/// stay until the end, since later subdivisions may need them.
class SampleTable {
 public:
  SampleTable() = default;
  explicit SampleTable(const renderer::Sampling& sampling) : sampling_(sampling) {}

  /// Colour shown for a sample.
  renderer::Rgb colour_of(const Point& point) const {
    const Sample& sample = at(point);
    return eval_shown(sampling_, sample.sums, sample.begun);
  }
  /// Returns the sample, and creates it if missing.
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

/// Quantities of a cell, from its samples. Only waiting rays of points_to_deepen() count.
Quantities find_quantities(const SampledCell& cell, const SampleTable& samples,
                           const Limits& limits, TaskWork& work);
/// Samples whose shading trees a cell needs: all, or only its own pixels if every pixel is sampled.
renderer::progressive::Points points_to_deepen(const SampledCell& cell);
/// True if all pixels of the cell have their final colour.
bool is_finished(const SampledCell& cell, const SampleTable& samples);

}  // namespace iirra
