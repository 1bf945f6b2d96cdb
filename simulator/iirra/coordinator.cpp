#include <algorithm>
#include <map>
#include <numeric>

#include "simulator/iirra/services.hpp"
#include "simulator/occam/case_of.hpp"
#include "simulator/occam/process.hpp"

namespace iirra {

using machine::Seconds;
using network::Message;
using occam::case_of;

void interact(Shared& shared, network::Client& client) {
  const int coordinator = shared.places.coordinator;
  for (bool has_left = false; !has_left;) {
    const std::size_t number = shared.orders.next(Seconds{shared.record.begun_s});
    has_left = std::holds_alternative<ray_tracing::Leave>(shared.orders[number].what);
    const IirraMessage order = UserOrder{number};
    client.send(network::make_message(TASK_PROCESS, {coordinator, TASK_PROCESS},
                                      shared.sizes.of(order), order));
  }
}

Coordinator::Coordinator(Shared& shared, shared_memory::DataManager& manager, network::Client& user)
    : shared_(shared), manager_(manager), user_(user), limits_(shared.params.stages[0]) {}

void Coordinator::run() {
  auto& record = shared_.record;
  record.before = observe::collect(shared_.machine);
  record.begun_s = record.last_task_s = interactive_since_s_ = Shared::occam_now();
  auto& self = machine::this_process();
  kernels::start(self.processor(), "interaction", machine::Priority::low,
                 [this] { interact(shared_, user_); });
  hand_out();
  while (occam::turn(!is_finished_)) obey(manager_.serve_at_once());
  end(Shared::occam_now());
  tell(network::make_global(TASK_PROCESS), Stop{});
  tell({shared_.places.display, DISPLAY_PROCESS}, Stop{});
  while (!is_quitting_) obey(manager_.serve_at_once());
  manager_.serve_for_ever();
}

void Coordinator::end(double at_s) {
  auto& record = shared_.record;
  if (record.ended_s > 0) return;
  record.ended_s = at_s;
  if (!is_last_) record.interactive_s += at_s - interactive_since_s_;
  record.after = observe::collect(shared_.machine);
}

// --- the first tasks ----------------------------------------------------------------------------

void Coordinator::hand_out() {
  const auto& params = shared_.params;
  const auto& workers = shared_.places.workers;
  auto cells = make_cells(shared_.area, params.max_cell);
  if (params.balance == BalanceMethod::green) {
    pool_ = std::move(cells);
    return;
  }
  const int columns = (shared_.area.width + params.max_cell - 1) / params.max_cell;
  const int rows = static_cast<int>(cells.size()) / columns;
  const auto worker_of =
      params.start == Start::subsampled
          ? measure_cells(cells)
          : assign(params.start, columns, rows, static_cast<int>(workers.size()));
  std::vector<std::vector<SampledCell>> first(workers.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    first[static_cast<std::size_t>(worker_of[i])].push_back(cells[i]);
  for (std::size_t i = 0; i < workers.size(); ++i) give_first(workers[i], std::move(first[i]));
}

// Sends image cells to a worker in as few messages as possible. If there are no cells for the
// worker, sends one empty message, after which the worker may request tasks.
void Coordinator::give_first(int worker, std::vector<SampledCell> cells) {
  const auto room = (shared_.longest - shared_.sizes.of(Tasks{})) / shared_.sizes.cell;
  for (std::size_t i = 0; i == 0 || i < cells.size();) {
    Tasks tasks;
    for (; tasks.cells.size() < room && i < cells.size(); ++i)
      tasks.cells.push_back({{cells[i]}, {}});
    manager_.look();
    tell({worker, TASK_PROCESS}, std::move(tasks));
    if (cells.empty()) return;
  }
}

// Assigns image cells to workers by measured time. First the cells are sent to the workers in
// rotation, to be measured. Then they are assigned in the order of descending time, each to the
// worker with the lowest sum of times. Returns for each cell the index of its worker.
std::vector<int> Coordinator::measure_cells(const std::vector<SampledCell>& cells) {
  const auto& workers = shared_.places.workers;
  const auto room = (shared_.longest - shared_.sizes.of(CellTimes{})) / (shared_.sizes.cell + 4);
  std::vector<Measure> asked(workers.size());
  std::size_t waiting = 0;
  const auto ask = [&](std::size_t worker) {
    if (asked[worker].cells.empty()) return;
    ++waiting;
    tell({workers[worker], TASK_PROCESS}, std::exchange(asked[worker], {}));
  };
  for (std::size_t i = 0; i < cells.size(); ++i) {
    auto& list = asked[i % workers.size()];
    list.cells.push_back(cells[i]);
    if (list.cells.size() == room) ask(i % workers.size());
  }
  for (std::size_t worker = 0; worker < workers.size(); ++worker) ask(worker);
  std::map<std::pair<int, int>, double> time_of;
  while (waiting > 0) {
    const Message message = manager_.serve_at_once();
    const auto* measured = std::get_if<CellTimes>(&read(shared_.sizes, message));
    if (!measured) {
      obey(message);
      continue;
    }
    --waiting;
    for (const auto& [cell, time_s] : measured->times_s) time_of[{cell.y, cell.x}] = time_s;
  }
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto time = [&](std::size_t i) { return time_of.at({cells[i].y, cells[i].x}); };
  std::ranges::stable_sort(order, std::ranges::greater{}, time);
  std::vector<double> loads_s(workers.size());
  std::vector<int> worker_of(cells.size());
  for (const std::size_t i : order) {
    const auto least = std::ranges::min_element(loads_s);
    *least += time(i);
    worker_of[i] = static_cast<int>(least - loads_s.begin());
  }
  return worker_of;
}

// Gives a child in the tree of requests the next cell that has not been distributed. Used by green
// balancing only.
void Coordinator::serve_demand(int child) {
  if (next_of_pool_ == pool_.size()) return;
  ++shared_.record.counts.moves;
  ++shared_.record.counts.tasks_moved;
  give_first(child, {pool_[next_of_pool_++]});
}

// --- phases -------------------------------------------------------------------------------------

void Coordinator::obey(const Message& message) {
  case_of(
      read(shared_.sizes, message), [&](const Report& report) { count(report); },
      [&](const UserOrder& order) { obey_user(order.place); },
      [&](const TaskRequest& request) {
        if (shared_.params.balance == BalanceMethod::green)
          return serve_demand(message.from.processor);
        // No worker on the route has served the request. Forwards it to the next worker in
        // rotation. This worker stores the request until it has tasks to spare.
        const auto& workers = shared_.places.workers;
        int to = request.asker;
        for (std::size_t tries = 0; to == request.asker && tries < workers.size(); ++tries)
          to = workers[next_worker_++ % workers.size()];
        if (to == request.asker) return;
        ++shared_.record.counts.requests;
        tell({to, TASK_PROCESS}, TaskRequest{request.asker, true});
      },
      [&](const Finished&) { is_finished_ = true; },
      [&](const auto&) { throw base::InvariantBroken("a message that is not for a coordinator"); });
}

void Coordinator::count(const Report& report) {
  if (report.phase != phase_ || is_finishing_) return;
  parked_ += report.parked;
  finished_pixels_ += report.finished;
  if (parked_ + finished_pixels_ == shared_.pixels()) end_phase();
}

// Called when the cell of every pixel is either finished or waits for wider limits than the present
// ones.
void Coordinator::end_phase() {
  if (finished_pixels_ == shared_.pixels()) {
    if (!is_last_ && stage_ + 1 < shared_.params.stages.size())
      shared_.record.notes.push_back(
          fmt::format("the picture was complete in stage {}", stage_ + 1));
    return finish();
  }
  const auto& stages = shared_.params.stages;
  if (stage_ < stages.size()) keep_picture(fmt::format("stage{}", stage_ + 1));
  if (++stage_ < stages.size()) return begin_phase(stages[stage_], false);
  is_null_ = !is_quitting_;
  if (is_quitting_) end_interactive();
}

void Coordinator::begin_phase(const Limits& limits, bool is_last, int order) {
  if (!is_last) limits_ = limits;
  if (is_last != is_last_) {
    const double now_s = Shared::occam_now();
    if (is_last)
      shared_.record.interactive_s += now_s - interactive_since_s_;
    else
      interactive_since_s_ = now_s;
  }
  is_last_ = is_last;
  is_null_ = false;
  parked_ = finished_pixels_ = 0;
  tell(network::make_global(TASK_PROCESS), NewPhase{++phase_, limits, order});
}

void Coordinator::end_interactive() { begin_phase(without_limits(limits_), true); }

void Coordinator::finish() {
  if (std::exchange(is_finishing_, true)) return;
  tell({shared_.places.display, DISPLAY_PROCESS}, Finish{});
}

void Coordinator::keep_picture(const std::string& name) {
  tell({shared_.places.display, DISPLAY_PROCESS}, KeepPicture{name});
}

std::string Coordinator::phase() const {
  if (is_finished_) return shared_.record.is_aborted ? "aborted" : "complete";
  if (is_null_) return "null mode: nothing is left within the limits";
  return is_last_ ? "non-interactive" : "interactive";
}

// --- the user -----------------------------------------------------------------------------------

void Coordinator::note(std::size_t order, const std::string& why) {
  shared_.record.notes.push_back(fmt::format("order {} had no effect: {}", order, why));
}

void Coordinator::obey_user(std::size_t place) {
  const auto what = shared_.orders[place].what;
  if (std::holds_alternative<ray_tracing::Leave>(what)) {
    is_quitting_ = true;
    if (is_null_ && !is_finishing_) end_interactive();
    return;
  }
  const std::size_t number = place + 1;
  shared_.record.orders_s.emplace_back(shared_.now_s(), std::nullopt);
  if (is_finishing_)
    return note(number, shared_.record.is_aborted ? "the run was already aborted"
                                                  : "the picture was complete");
  const auto begin_interactive = [&](const Limits& limits) {
    keep_picture(fmt::format("order{}", number));
    stage_ = shared_.params.stages.size();
    begin_phase(limits, false, static_cast<int>(number));
  };
  case_of(
      what,
      [&](const Limits& limits) {
        if (is_last_) return note(number, "the interactive phase was already over");
        begin_interactive(limits);
      },
      [&](ray_tracing::NonInteractive) {
        if (is_last_) return note(number, "the interactive phase was already over");
        keep_picture(fmt::format("order{}", number));
        end_interactive();
      },
      [&](ray_tracing::Interactive) {
        if (!is_last_) return note(number, "the interactive phase was not over");
        begin_interactive(limits_);
      },
      [&](ray_tracing::Abort) {
        shared_.record.is_aborted = true;
        finish();
      },
      [](ray_tracing::Leave) {}, [&](const ray_tracing::Save& save) { keep_picture(save.name); });
}

void Coordinator::tell(network::Address to, IirraMessage content) {
  send(manager_, shared_.sizes, TASK_PROCESS, to, std::move(content));
}

}  // namespace iirra
