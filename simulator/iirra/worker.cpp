#include "simulator/iirra/worker.hpp"

#include "simulator/occam/case_of.hpp"
#include "simulator/occam/process.hpp"

namespace iirra {

namespace progressive = renderer::progressive;
using machine::this_process;
using network::Message;
using occam::case_of;

Worker::Worker(Shared& shared, shared_memory::DataManager& manager, Peers peers)
    : shared_(shared),
      manager_(manager),
      params_(shared.params),
      sizes_(shared.sizes),
      counts_(shared.record.counts),
      balance_(make_balance(params_.balance, *this, std::move(peers))),
      sampler_(shared, manager, [this] { serve_urgent(); }),
      unshown_(shared),
      tasks_(shared, sampler_, unshown_),
      has_begun_(params_.balance == BalanceMethod::green) {}

void Worker::run() {
  work();
  manager_.serve_for_ever();  // serves requests that other processors sent before they were stopped
}

void Worker::work() {
  while (occam::turn(!is_stopped_)) {
    serve_waiting();
    if (is_stopped_) return;
    const auto task = tasks_.take();
    if (!task) {
      rest();
      continue;
    }
    shared_.record.last_task_s = this_process().now().value;
    if (tasks_.active() < static_cast<std::size_t>(params_.reserve)) balance_->ask();
    advance(*task);
    balance_->worked();
  }
}

// Called when no task is left: reports to the coordinator, requests tasks and waits for a message.
void Worker::rest() {
  if (!params_.is_polled) send_pictures();
  if (tasks_.active() > 0 || is_stopped_) return;  // tasks have arrived while pictures were sent
  if (const auto report = tasks_.report())
    send_to({shared_.places.coordinator, TASK_PROCESS}, *report);
  if (has_begun_) balance_->ask();
  obey(manager_.serve_at_once());
}

void Worker::advance(const Task& task) {
  TaskCell cell = task.cell;
  if (task.next == Advance::divide) return divide_cell(cell);
  const int order = tasks_.order();
  if (task.next == Advance::sample)
    sample_next_level(cell);
  else
    deepen(cell, task.quantities.pass, task.quantities.depth);
  if (is_stopped_) return;
  const auto& samples = sampler_.samples();
  if (cell.level > 0 && !is_finished(cell, samples)) unshown_.paint(cell, samples, order);
  tasks_.put(cell);
  if (!params_.is_polled) send_pictures();
}

void Worker::sample_next_level(TaskCell& cell) {
  const std::uint32_t phase = tasks_.phase();
  const auto points = points_of_level(cell, cell.level + 1);
  for (auto i = static_cast<std::size_t>(cell.sampled); i < points.size(); ++i) {
    if (tasks_.phase() != phase || is_stopped_) return;
    ++cell.sampled;
    if (sampler_.samples().has(points[i])) {
      ++counts_.samples_shared;
      continue;
    }
    sampler_.begin(points[i]);
    serve_waiting();
  }
  cell.sampled = 0;
  ++cell.level;
}

void Worker::divide_cell(const TaskCell& cell) {
  ++counts_.cells_divided;
  for (const auto& daughter : progressive::divide(cell)) {
    if (tasks_.pixels_of(daughter) == 0) continue;
    for (const Point& p : points_of(daughter))
      if (!sampler_.samples().has(p))
        throw base::InvariantBroken("a sample that does not belong to the divided cell");
    tasks_.put({daughter, cell.paintings, 0});
  }
  balance_->created();
}

// Traces level `level` of the shading trees of all points in the cell, for sample number `pass` of
// each point's pixel.
void Worker::deepen(const SampledCell& cell, int pass, int level) {
  const std::uint32_t phase = tasks_.phase();
  for (const Point& p : points_to_deepen(cell)) {
    if (tasks_.phase() != phase || is_stopped_) return;
    sampler_.deepen(p, pass, level, tasks_.limits());
    serve_waiting();
  }
}

// Called between samples, when no sample is incomplete: handles all messages.
void Worker::serve_waiting() {
  serve_urgent();
  while (!deferred_.empty()) {
    const Message message = std::move(deferred_.front());
    deferred_.pop_front();
    obey(message);
  }
}

// Called between the rays of a sample: handles only messages that do not change the present cell.
void Worker::serve_urgent() {
  while (auto message = manager_.take_other()) {
    const auto& content = network::read<IirraMessage>(*message);
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
        for (const auto& moved : tasks.cells) tasks_.receive(moved, is_first);
        has_begun_ = true;
        balance_->received(from, tasks.load);
      },
      [&](const TaskRequest& request) { balance_->requested(message, request); },
      [&](const NoTasks& refusal) { balance_->refused(from, refusal.load); },
      [&](const Measure& cells) { measure(from, cells); },
      [&](const NewPhase& phase) {
        if (tasks_.begin_phase(phase)) balance_->created();
      },
      [&](const Poll&) {
        send_to({from, DISPLAY_PROCESS}, unshown_.take());
      },
      [&](const PictureShown&) { is_under_way_ = false; }, [&](const Stop&) { is_stopped_ = true; },
      [&](const auto&) { throw base::InvariantBroken("a message that is not for a worker"); });
}

// Measures how long it takes to trace the whole shading tree of each cell's middle point.
void Worker::measure(int asker, const Measure& asked) {
  CellTimes measured;
  for (const auto& cell : asked.cells) {
    const double since_s = this_process().now().value;
    sampler_.measure({cell.x + cell.side / 2, cell.y + cell.side / 2});
    measured.times_s.emplace_back(cell, this_process().now().value - since_s);
  }
  send_to({asker, TASK_PROCESS}, std::move(measured));
}

// If the display does not poll: sends the next picture as soon as the display has acknowledged the
// previous one.
void Worker::send_pictures() {
  while (!unshown_.empty() && !is_stopped_) {
    if (!std::exchange(is_under_way_, true))
      send_to({shared_.places.display, DISPLAY_PROCESS}, unshown_.take());
    serve_waiting();
    while (is_under_way_ && !is_stopped_) obey(manager_.serve_at_once());
  }
}

std::size_t Worker::give(int to) {
  auto shared = tasks_.share();
  if (!shared) return 0;
  const std::size_t given = shared->cells.size();
  send_to({to, TASK_PROCESS}, *std::move(shared));
  return given;
}

void Worker::send_to(network::Address to, IirraMessage content) {
  counts_.requests += std::holds_alternative<TaskRequest>(content);
  counts_.refusals += std::holds_alternative<NoTasks>(content);
  send(manager_, sizes_, TASK_PROCESS, to, std::move(content));
}

void Worker::pass_on(const Message& message) { manager_.client().give_back(message); }

}  // namespace iirra
