#include "simulator/iirra/worker.hpp"

#include <algorithm>

#include "simulator/occam/case_of.hpp"
#include "simulator/occam/process.hpp"

namespace iirra {

namespace progressive = renderer::progressive;
using machine::this_process;
using network::Message;
using occam::case_of;
using renderer::Ray;

namespace {

bool is_in(const renderer::Area& area, const Point& p) {
  return p.x >= area.x && p.y >= area.y && p.x < area.x + area.width && p.y < area.y + area.height;
}

// True if p is inside the cell, where no other cell has a sample.
bool is_inner(const SampledCell& cell, const Point& p) {
  return p.x > cell.x && p.y > cell.y && p.x < cell.x + cell.side && p.y < cell.y + cell.side;
}

Ordering make_ordering(const Shared& shared) {
  const Params& p = shared.params;
  const bool is_scan = p.pixels == ray_tracing::PixelOrder::scan;
  return {shared.area, p.max_cell, is_scan ? CellOrder::sequential : p.order,
          p.seed,      p.weights,  shared.quadrants};
}

machine::Memory& own_memory() { return this_process().processor().memory(); }
void allocate(std::uint64_t bytes, const char* what) {
  own_memory().allocate(bytes, what, this_process().own_time());
}

}  // namespace

Worker::Worker(Shared& shared, shared_memory::DataManager& manager, Peers peers)
    : shared_(shared),
      manager_(manager),
      params_(shared.params),
      sizes_(shared.sizes),
      counts_(shared.record.counts),
      ordering_(make_ordering(shared)),
      balance_(make_balance(params_.balance, *this, std::move(peers))),
      samples_(params_.image.sampling),
      limits_(params_.stages[0]),
      unshown_(shared),
      has_begun_(params_.balance == BalanceMethod::green) {}

void Worker::run() {
  work();
  manager_.serve_for_ever();  // serves requests that others sent before they were stopped
}

void Worker::work() {
  while (occam::turn(!is_stopped_)) {
    serve_waiting();
    if (is_stopped_) return;
    const auto task = stores_.take(work_);
    charge_work();
    if (!task) {
      rest();
      continue;
    }
    own_memory().release(sizes_.cell);
    shared_.record.last_task_s = this_process().now().value;
    if (stores_.active() < static_cast<std::size_t>(params_.reserve)) balance_->ask();
    advance(*task);
    balance_->worked();
  }
}

// --- application --------------------------------------------------------------------------------

void Worker::advance(const Task& task) {
  TaskCell cell = task.cell;
  if (task.next == Advance::divide) return divide_cell(cell);
  const int order = order_;
  if (task.next == Advance::sample)
    sample_next_level(cell);
  else
    deepen(cell, task.quantities.pass, task.quantities.depth);
  if (is_stopped_) return;
  if (cell.level > 0 && !is_finished(cell, samples_)) unshown_.paint(cell, samples_, order);
  put(cell);
  if (!params_.is_polled) send_pictures();
}

void Worker::sample_next_level(TaskCell& cell) {
  const std::uint32_t phase = phase_;
  const auto points = points_of_level(cell, cell.level + 1);
  for (auto i = static_cast<std::size_t>(cell.sampled); i < points.size(); ++i) {
    if (phase_ != phase || is_stopped_) return;
    const Point& p = points[i];
    ++cell.sampled;
    if (samples_.has(p)) {
      ++counts_.samples_shared;
      continue;
    }
    const bool is_outside = !is_in(shared_.area, p);
    ++counts_.samples;
    counts_.samples_outside += is_outside;
    allocate(sizes_.sample, "samples");
    open_ = p;
    Sample& sample = samples_[p];
    trace(sample, make_primary(shared_.scene.view, params_.image, p.x, p.y), is_outside);
    if (!is_outside) extend(sample, p);
    open_.reset();
    serve_waiting();
  }
  cell.sampled = 0;
  ++cell.level;
}

void Worker::divide_cell(const TaskCell& cell) {
  ++counts_.cells_divided;
  for (const auto& daughter : progressive::divide(cell)) {
    if (pixels_of(daughter) == 0) continue;
    for (const Point& p : points_of(daughter))
      if (!samples_.has(p)) throw base::InvariantBroken("a sample that a divided cell has not");
    put({daughter, cell.paintings, 0});
  }
  balance_->created();
}

// Traces level `level` of the shading trees of the cell's samples, for sample number `pass` of each
// pixel.
void Worker::deepen(const SampledCell& cell, int pass, int level) {
  const std::uint32_t phase = phase_;
  for (const Point& p : points_to_deepen(cell)) {
    if (phase_ != phase || is_stopped_) return;
    open_ = p;
    Sample& sample = samples_.at(p);
    const bool is_outside = !is_in(shared_.area, p);
    for (std::size_t i = 0; i < sample.waiting.size();) {
      const Ray ray = sample.waiting[i];
      if (ray.pass != pass || ray.level != level || !is_within(ray, limits_)) {
        ++i;
        continue;
      }
      sample.waiting.erase(sample.waiting.begin() + static_cast<std::ptrdiff_t>(i));
      own_memory().release(sizes_.ray);
      trace(sample, ray, is_outside);
    }
    if (!is_outside) extend(sample, p);
    open_.reset();
    serve_waiting();
  }
}

// Traces a ray and the shadow feelers from its hit; queues all other children.
void Worker::trace(Sample& sample, const Ray& ray, bool is_outside) {
  const auto& sampling = params_.image.sampling;
  const bool is_judged = is_adaptive(sampling) && !is_outside;
  if (ray.level == 1 && sample.begun++ == 0) sample.open = renderer::OpenPixel(sampling);
  const auto keep = [&](const Ray& shot, const Traced& traced) {
    if (!is_judged) return;
    if (shot.level == 1) allocate(sizes_.pixel, "samples of pixels");
    sample.open.add(shot, traced.hit, traced.contribution);
  };
  const Traced traced = shoot(sample, ray, is_outside);
  keep(ray, traced);
  for (const Ray& child : traced.children)
    if (child.kind == renderer::RayKind::shadow) {
      keep(child, shoot(sample, child, is_outside));
    } else {
      allocate(sizes_.ray, "rays that wait");
      sample.waiting.push_back(child);
    }
}

// Queues the pixel's next sample if one is needed and the previous one has begun.
void Worker::extend(Sample& sample, const Point& p) {
  const auto& sampling = params_.image.sampling;
  if (sampling.pixel_samples == 1) return;
  const bool is_primary_waiting =
      std::ranges::any_of(sample.waiting, [](const Ray& ray) { return ray.level == 1; });
  if (is_primary_waiting) return;
  const int wanted = is_adaptive(sampling) ? find_wanted(sample, p) : sampling.pixel_samples;
  if (sample.begun >= wanted) return;
  allocate(sizes_.ray, "rays that wait");
  sample.waiting.push_back(make_primary(shared_.scene.view, params_.image, p.x, p.y, sample.begun));
}

// For adaptive sampling: after each round, finds the objects at the pixel's corners and returns the
// number of samples needed.
int Worker::find_wanted(Sample& sample, const Point& p) {
  auto& open = sample.open;
  if (sample.begun < open.wanted || !sample.waiting.empty() || open.samples.empty())
    return open.wanted;
  renderer::Corners corners;
  for (int i = 0; i < 4; ++i) {
    const Ray probe = make_probe(shared_.scene.view, params_.image, p.x + i % 2, p.y + i / 2);
    const auto [corner, is_new] = corners_.try_emplace(probe.path, renderer::NO_OBJECT);
    if (is_new) {
      Sample nothing;
      const auto hit = shoot(nothing, probe, false).hit;
      corners_[probe.path] = hit ? hit->object : renderer::NO_OBJECT;
    }
    corners[static_cast<std::size_t>(i)] = corners_[probe.path];
  }
  open.wanted = renderer::find_wanted(params_.image.sampling, open.samples, corners);
  if (open.wanted == sample.begun) {
    sample.sums =
        repeat(eval_estimate(params_.image.sampling, open.samples, corners), sample.begun);
    own_memory().release(sizes_.pixel * open.samples.size());
    open.samples.clear();
  }
  return open.wanted;
}

namespace {

Traced trace_ray(const renderer::Scene& scene, const renderer::Params& params, const Ray& ray,
                 renderer::Work& work, renderer::Access* access = nullptr) {
  Traced traced;
  traced.hit = intersect(scene, ray, params.traversal, work, access);
  if (ray.kind == renderer::RayKind::probe) return traced;
  traced.contribution = eval_contribution(scene, params, ray, traced.hit, work);
  if (traced.hit) make_children(scene, params, ray, *traced.hit, traced.children, work);
  return traced;
}

}  // namespace

Traced Worker::shoot(Sample& sample, const Ray& ray, bool is_outside) {
  look();
  const auto& scene = shared_.scene;
  const auto& params = params_.image;
  Traced traced;
  if (!shared_.items) {
    traced = shared_.ray_cost([&scene, &params, ray](renderer::Work& work) {
      return trace_ray(scene, params, ray, work);
    });
  } else {
    const double scale = shared_.ray_cost.eval_scale(
        shared_.scratch, [&scene, &params, ray](Traced& to, auto& work) {
          to = trace_ray(scene, params, ray, work);
        });
    shared_memory::SceneReader reader(*shared_.items, manager_, shared_.ray_cost.counted(), scale);
    renderer::Work work;
    traced = trace_ray(scene, params, ray, work, &reader);
    reader.charge(work);
    shared_.charged_with_data += reader.charged();
    shared_.charged_with_data_s += this_process().processor().duration(reader.charged());
  }
  const bool is_hit = traced.hit.has_value();
  add(sample.sums, traced.contribution);
  sample.rays.add(ray.kind, is_hit);
  shared_.record.rays.add(ray.kind, is_hit);
  if (is_outside) shared_.record.rays_outside.add(ray.kind, is_hit);
  return traced;
}

// --- task manager -------------------------------------------------------------------------------

std::uint64_t Worker::pixels_of(const SampledCell& cell) const {
  const auto& area = shared_.area;
  const auto overlap = [](int a, int a_size, int b, int b_size) {
    return static_cast<std::uint64_t>(
        std::max(0, std::min(a + a_size, b + b_size) - std::max(a, b)));
  };
  return overlap(cell.x, cell.side, area.x, area.width) *
         overlap(cell.y, cell.side, area.y, area.height);
}

void Worker::put(const TaskCell& cell, bool has_just_come) {
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

void Worker::finish(TaskCell cell) {
  unshown_.paint(cell, samples_, order_);
  for (const Point& p : points_to_deepen(cell))
    if (is_in(shared_.area, p)) {
      const Sample& sample = samples_.at(p);
      shared_.record.finish(p.x, p.y, eval_final(params_.image.sampling, sample.sums, sample.begun),
                            sample.rays);
    }
  finished_ += pixels_of(cell);
  new_finished_ += pixels_of(cell);
}

// Handles a worker without tasks: reports to the coordinator, requests tasks and waits.
void Worker::rest() {
  if (!params_.is_polled) send_pictures();
  if (stores_.active() > 0 || is_stopped_) return;  // tasks have arrived meanwhile
  report();
  if (has_begun_) balance_->ask();
  obey(manager_.serve_at_once());
}

void Worker::report() {
  if (stores_.active() > 0 || new_parked_ + new_finished_ == 0) return;
  ++counts_.reports;
  send_to({shared_.places.coordinator, TASK_PROCESS},
          Report{phase_, std::exchange(new_parked_, 0), std::exchange(new_finished_, 0)});
}

void Worker::begin_phase(const NewPhase& phase) {
  if (phase.phase <= phase_) return;
  phase_ = phase.phase;
  limits_ = phase.limits;
  order_ = phase.order;
  new_parked_ = 0;
  new_finished_ = finished_;
  for (const Task& task : stores_.take_all()) {
    own_memory().release(sizes_.cell);
    put(task.cell);
  }
  balance_->created();
}

std::size_t Worker::give(int to) {
  const auto reserve = static_cast<std::size_t>(params_.reserve);
  if (stores_.active() <= reserve) return 0;
  const std::size_t most = (stores_.active() - reserve + 1) / 2;
  Tasks tasks;
  std::uint64_t bytes = sizes_.of(tasks);
  // To prevent tasks from circulating, a received task may not be sent on before it was worked on.
  // In a tree it cannot circulate.
  const bool goes_on = params_.balance == BalanceMethod::green;
  const auto may_go = [&](const Task& task) {
    if (task.has_just_come && !goes_on) return false;
    std::uint64_t needed = bytes + sizes_.cell;
    for (const Point& p : points_of(task.cell)) {
      if (p == open_) return false;
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
  if (given == 0) return 0;
  ++counts_.moves;
  counts_.tasks_moved += given;
  counts_.bytes_moved += bytes;
  tasks.load = stores_.active();
  send_to({to, TASK_PROCESS}, std::move(tasks));
  return given;
}

// Moves the samples inside the cell, which no other cell needs, and copies those on its border.
MovedCell Worker::pack(const TaskCell& cell) {
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
  // the receiver restarts an incomplete level
  if (cell.sampled > 0)
    for (int i = 0; i < cell.sampled; ++i)
      forget_inner(points_of_level(cell, cell.level + 1)[static_cast<std::size_t>(i)]);
  moved.cell.sampled = 0;
  return moved;
}

// Stores received samples. Of two states of a sample, keeps the more advanced one.
void Worker::unpack(const MovedCell& moved, bool is_first) {
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

void Worker::charge_work() {
  this_process().charge(shared_.task_cost.here()(std::exchange(work_, {}).counts()));
}

// --- network ------------------------------------------------------------------------------------

// Called between samples: handles all messages.
void Worker::serve_waiting() {
  look();
  while (!deferred_.empty()) {
    const Message message = std::move(deferred_.front());
    deferred_.pop_front();
    obey(message);
  }
}

// Called between rays of a sample: handles only messages that do not affect the current cell.
void Worker::look() {
  while (auto message = manager_.take_other()) {
    const auto& content = static_cast<const IirraMessage&>(*message->contents).content;
    if (std::holds_alternative<Poll>(content) || std::holds_alternative<TaskRequest>(content) ||
        std::holds_alternative<NoTasks>(content))
      obey(*message);
    else
      deferred_.push_back(*std::move(message));
  }
}

void Worker::obey(const Message& message) {
  const int from = message.from.processor;
  case_of(
      read(sizes_, message),
      [&](const Tasks& tasks) {
        const bool is_first = from == shared_.places.coordinator;
        for (const auto& moved : tasks.cells) unpack(moved, is_first);
        has_begun_ = true;
        balance_->received(from, tasks.load);
      },
      [&](const TaskRequest& request) { balance_->requested(message, request); },
      [&](const NoTasks& refusal) { balance_->refused(from, refusal.load); },
      [&](const Measure& cells) { measure(from, cells); },
      [&](const NewPhase& phase) { begin_phase(phase); },
      [&](const Poll&) {
        send_to({from, DISPLAY_PROCESS}, unshown_.take());
      },
      [&](const PictureShown&) { is_under_way_ = false; }, [&](const Stop&) { is_stopped_ = true; },
      [&](const auto&) { throw base::InvariantBroken("a message that is not for a worker"); });
}

// Measures the time to trace the whole shading tree of each cell's middle sample.
void Worker::measure(int asker, const Measure& asked) {
  CellTimes measured;
  for (const auto& cell : asked.cells) {
    const double since_s = this_process().now().value;
    Sample sample;
    const Point middle{cell.x + cell.side / 2, cell.y + cell.side / 2};
    sample.waiting = {make_primary(shared_.scene.view, params_.image, middle.x, middle.y)};
    while (!sample.waiting.empty()) {
      const Ray ray = sample.waiting.back();
      sample.waiting.pop_back();
      for (const Ray& child : shoot(sample, ray, !is_in(shared_.area, middle)).children)
        sample.waiting.push_back(child);
    }
    ++counts_.samples;
    counts_.samples_outside += !is_in(shared_.area, middle);
    measured.times_s.emplace_back(cell, this_process().now().value - since_s);
  }
  send_to({asker, TASK_PROCESS}, std::move(measured));
}

// Without polling: sends the next picture when the display has acknowledged the previous one.
void Worker::send_pictures() {
  while (!unshown_.empty() && !is_stopped_) {
    if (!std::exchange(is_under_way_, true))
      send_to({shared_.places.display, DISPLAY_PROCESS}, unshown_.take());
    serve_waiting();
    while (is_under_way_ && !is_stopped_) obey(manager_.serve_at_once());
  }
}

void Worker::send_to(network::Address to, IirraMessage::Content content) {
  counts_.requests += std::holds_alternative<TaskRequest>(content);
  counts_.refusals += std::holds_alternative<NoTasks>(content);
  send(manager_, sizes_, TASK_PROCESS, to, std::move(content));
}

void Worker::pass_on(const Message& message) { manager_.client().give_back(message); }

}  // namespace iirra
