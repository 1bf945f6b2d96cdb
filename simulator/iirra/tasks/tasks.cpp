#include "simulator/iirra/tasks/tasks.hpp"

#include <algorithm>

#include "simulator/kernels/counted_heap.hpp"

namespace iirra {

namespace progressive = renderer::progressive;

namespace {

// The number of the sample, among the samples of each pixel, that the task's next step works on.
// Tasks with lower numbers come first.
int pass_of(const Task& task) { return task.next == Advance::deepen ? task.quantities.pass : 0; }

bool goes_before(const Task& a, const Task& b) {
  if (pass_of(a) != pass_of(b)) return pass_of(a) < pass_of(b);
  if (a.importance.sum != b.importance.sum) return a.importance.sum > b.importance.sum;
  if (a.importance.place != b.importance.place) return a.importance.place < b.importance.place;
  return std::pair(a.cell.y, a.cell.x) < std::pair(b.cell.y, b.cell.x);
}

}  // namespace

void TaskStores::add(const Task& task, TaskWork& work) {
  ++work.record_stored;
  auto& store = task.next == Advance::none ? later_ : heap_;
  store.push_back(task);
  if (task.next != Advance::none)
    work.heap_step += kernels::sift_up(heap_, heap_.size() - 1, goes_before);
}

std::optional<Task> TaskStores::take(TaskWork& work) {
  if (heap_.empty()) return std::nullopt;
  ++work.record_stored;
  std::swap(heap_.front(), heap_.back());
  const Task first = heap_.back();
  heap_.pop_back();
  if (!heap_.empty()) work.heap_step += kernels::sift_down(heap_, 0, goes_before);
  return first;
}

std::optional<Task> TaskStores::take_last(const std::function<bool(const Task&)>& may_go,
                                          TaskWork& work) {
  const std::size_t end = heap_.size() - std::min(heap_.size(), LOOKED_AT);
  for (std::size_t i = heap_.size(); i-- > end;) {
    if (!may_go(heap_[i])) continue;
    ++work.record_stored;
    const Task task = heap_[i];
    std::swap(heap_[i], heap_.back());
    heap_.pop_back();
    if (i < heap_.size()) {
      work.heap_step += kernels::sift_up(heap_, i, goes_before);
      work.heap_step += kernels::sift_down(heap_, i, goes_before);
    }
    return task;
  }
  return std::nullopt;
}

std::vector<Task> TaskStores::take_all() {
  std::vector<Task> all = std::exchange(heap_, {});
  all.insert(all.end(), later_.begin(), later_.end());
  later_.clear();
  return all;
}

progressive::Points points_to_deepen(const SampledCell& cell) {
  auto points = points_of(cell);
  if (cell.side > 2 || cell.level < last_level(cell)) return points;
  progressive::Points own;
  for (const Point& p : points)
    if (owns(cell, p)) own.push_back(p);
  return own;
}

Quantities find_quantities(const SampledCell& cell, const SampleTable& samples,
                           const Limits& limits, TaskWork& work) {
  Quantities found;
  ++work.ray_classified;
  if (cell.level == 0) return found;
  std::optional<progressive::Range> range;
  for (const Point& p : points_of(cell)) {
    const auto colour = samples.colour_of(p);
    ++work.cell_judged;
    range = widen(range.value_or(progressive::Range{colour, colour}), colour);
  }
  found.contrast = std::clamp(eval_contrast(*range), 0.0, 1.0);
  for (const Point& p : points_to_deepen(cell))
    for (const auto& ray : samples.at(p).waiting) {
      ++work.ray_classified;
      if (!is_within(ray, limits) || (found.depth > 0 && ray.pass > found.pass)) continue;
      if (found.depth == 0 || ray.pass < found.pass) found.depth = ray.level, found.influence = 0;
      found.pass = ray.pass;
      found.depth = std::min<int>(found.depth, ray.level);
      found.influence = std::max(found.influence, max_influence(ray));
    }
  return found;
}

bool is_finished(const SampledCell& cell, const SampleTable& samples) {
  if (cell.side > 2 || cell.level < last_level(cell)) return false;
  return std::ranges::all_of(points_to_deepen(cell),
                             [&](const Point& p) { return samples.at(p).waiting.empty(); });
}

}  // namespace iirra
