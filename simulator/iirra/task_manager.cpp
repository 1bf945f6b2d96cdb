#include "simulator/iirra/task_manager.hpp"

#include <algorithm>

namespace iirra {

using machine::this_process;

namespace {

// True if p is strictly inside the cell. Cells share only samples on their borders, so no other
// cell uses a sample at p.
bool is_inner(const SampledCell& cell, const Point& p) {
  return p.x > cell.x && p.y > cell.y && p.x < cell.x + cell.side && p.y < cell.y + cell.side;
}

Ordering make_ordering(const Shared& shared) {
  const Params& p = shared.params;
  const bool is_scan = p.pixels == ray_tracing::PixelOrder::scan;
  return {shared.area, p.max_cell, is_scan ? CellOrder::sequential : p.order,
          p.seed,      p.weights,  shared.quadrants};
}

}  // namespace

TaskManager::TaskManager(Shared& shared, Sampler& sampler, FrameBuffers& unshown)
    : shared_(shared),
      params_(shared.params),
      sizes_(shared.sizes),
      counts_(shared.record.counts),
      ordering_(make_ordering(shared)),
      sampler_(sampler),
      samples_(sampler.samples()),
      unshown_(unshown),
      limits_(params_.stages[0]) {}

std::uint64_t TaskManager::pixels_of(const SampledCell& cell) const {
  const auto& area = shared_.area;
  const auto overlap = [](int a, int a_size, int b, int b_size) {
    return static_cast<std::uint64_t>(
        std::max(0, std::min(a + a_size, b + b_size) - std::max(a, b)));
  };
  return overlap(cell.x, cell.side, area.x, area.width) *
         overlap(cell.y, cell.side, area.y, area.height);
}

std::optional<Task> TaskManager::take() {
  auto task = stores_.take(work_);
  charge_work();
  if (task) own_memory().release(sizes_.cell);
  return task;
}

void TaskManager::put(const TaskCell& cell, bool has_just_come) {
  if (is_finished(cell, samples_)) return finish(cell);
  Task task{cell, find_quantities(cell, samples_, limits_, work_)};
  task.next = choose(cell, task.quantities, limits_);
  task.has_just_come = has_just_come;
  task.importance = ordering_.eval(cell, task.quantities, limits_);
  if (task.next == Advance::none) new_parked_ += pixels_of(cell);
  allocate(sizes_.cell, "tasks");
  stores_.add(task, work_);
  counts_.tasks_most = std::max(counts_.tasks_most, stores_.active() + stores_.parked());
  charge_work();
}

void TaskManager::finish(TaskCell cell) {
  unshown_.paint(cell, samples_, order_);
  for (const Point& p : points_to_deepen(cell))
    if (!shared_.is_outside(p)) {
      const Sample& sample = samples_.at(p);
      shared_.record.finish(p.x, p.y, eval_final(params_.image.sampling, sample.sums, sample.begun),
                            sample.rays);
    }
  finished_ += pixels_of(cell);
  new_finished_ += pixels_of(cell);
}

std::optional<Report> TaskManager::report() {
  if (stores_.active() > 0 || new_parked_ + new_finished_ == 0) return {};
  ++counts_.reports;
  return Report{phase_, std::exchange(new_parked_, 0), std::exchange(new_finished_, 0)};
}

bool TaskManager::begin_phase(const NewPhase& phase) {
  if (phase.phase <= phase_) return false;
  phase_ = phase.phase;
  limits_ = phase.limits;
  order_ = phase.order;
  new_parked_ = 0;
  new_finished_ = finished_;
  for (const Task& task : stores_.take_all()) {
    own_memory().release(sizes_.cell);
    put(task.cell);
  }
  return true;
}

std::optional<Tasks> TaskManager::share() {
  const auto reserve = static_cast<std::size_t>(params_.reserve);
  if (stores_.active() <= reserve) return {};
  const std::size_t most = (stores_.active() - reserve + 1) / 2;
  Tasks tasks;
  std::uint64_t bytes = sizes_.of(tasks);
  // A received task may be given away only after this worker has worked on it, so that tasks do not
  // circulate. With `green` balancing tasks move only down a tree, so they may be given away at
  // once.
  const bool goes_on = params_.balance == BalanceMethod::green;
  const auto may_go = [&](const Task& task) {
    if (task.has_just_come && !goes_on) return false;
    std::uint64_t needed = bytes + sizes_.cell;
    for (const Point& p : points_of(task.cell)) {
      if (sampler_.is_open(p)) return false;
      needed += sizes_.of(samples_.at(p));
    }
    return needed <= shared_.longest;
  };
  while (tasks.cells.size() < most) {
    const auto task = stores_.take_last(may_go, work_);
    if (!task) break;
    own_memory().release(sizes_.cell);
    tasks.cells.push_back(pack(task->cell));
    bytes += sizes_.of(tasks.cells.back());
  }
  charge_work();
  const std::size_t given = tasks.cells.size();
  if (given == 0) return {};
  ++counts_.moves;
  counts_.tasks_moved += given;
  counts_.bytes_moved += bytes;
  tasks.load = stores_.active();
  return tasks;
}

// Packs a cell for another processor. Moves the samples inside the cell, which no other cell needs,
// and copies the samples on its border.
MovedCell TaskManager::pack(const TaskCell& cell) {
  MovedCell moved{cell, {}};
  const auto forget_inner = [&](const Point& p) {
    if (!is_inner(cell, p)) return;
    own_memory().release(sizes_.of(samples_.at(p)));
    samples_.erase(p);
  };
  for (const Point& p : points_of(cell)) {
    moved.samples.push_back(samples_.at(p));
    forget_inner(p);
  }
  // The receiver computes all samples of an incomplete level anew.
  if (cell.sampled > 0)
    for (int i = 0; i < cell.sampled; ++i)
      forget_inner(points_of_level(cell, cell.level + 1)[static_cast<std::size_t>(i)]);
  moved.cell.sampled = 0;
  return moved;
}

// Stores received samples. If the processor already has a sample, keeps the one with more traced
// rays.
void TaskManager::receive(const MovedCell& moved, bool is_first) {
  std::size_t i = 0;
  for (const Point& p : points_of(moved.cell)) {
    const Sample& sample = moved.samples.at(i++);
    if (samples_.has(p)) {
      if (samples_.at(p).rays.total() >= sample.rays.total()) continue;
      own_memory().release(sizes_.of(samples_.at(p)));
    }
    allocate(sizes_.of(sample), "samples");
    samples_[p] = sample;
  }
  put(moved.cell, !is_first);
}

void TaskManager::charge_work() {
  this_process().charge(shared_.task_cost.here()(std::exchange(work_, {}).counts()));
}

}  // namespace iirra
