#include "experiments/laboratory/live/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <thread>

#include "base/errors.hpp"
#include "experiments/laboratory/host/interrupt.hpp"

namespace laboratory {

using machine::Seconds;
using nlohmann::ordered_json;
using std::chrono_literals::operator""ms, std::chrono_literals::operator""ns;

namespace {

// host time between checks for interrupts while the run is paused
constexpr auto LOOK_EVERY = 50ms;
// least host time between frames at full speed, because making frames slows the run
constexpr auto FRAMES_AT_FULL_SPEED = 95ms;
// host time between samples of the growth curves while no frame is made
constexpr auto SAMPLE_EVERY = 100ms;
// host time by which a paced run may fall behind before its pace is reset
constexpr double MOST_ARREARS_S = 0.25;
// number of events between two checks for commands while the machine runs
constexpr std::uint64_t CALLS_BETWEEN = 1024;
// limit on commands of pages that are queued for execution
constexpr std::size_t MOST_ASKED = 1024;
// limit on processors that pages can still inspect after the end of the run
constexpr std::size_t MOST_TOLD_AT_END = 256;

// True if the experiment file has an [[order]] with which the simulated user leaves.
bool has_leave(const ExperimentFile& file) {
  const auto* orders = (*file.content)["order"].as_array();
  return orders && std::any_of(orders->begin(), orders->end(), [](const toml::node& order) {
           return order.is_table() && (*order.as_table())["leave"].value_or(false);
         });
}

}  // namespace

Session::Session(const ExperimentFile& file, double speed)
    : file_(file),
      orders_(file.points.at(0).experiment.program->find_list("order")),
      stages_(file.points[0].experiment.program->find_list("stage")),
      faults_(file.points[0].experiment.faults),
      speed_(speed),
      pace_since_(HostClock::now()) {}

// --- for pages --------------------------------------------------------------------------------

std::shared_ptr<const ordered_json> Session::outline() const {
  const std::lock_guard lock(mutex_);
  return outline_;
}

std::shared_ptr<const Frame> Session::frame() const {
  const std::lock_guard lock(mutex_);
  return frame_;
}

void Session::ask(Command command, Reply reply) {
  {
    const std::lock_guard lock(mutex_);
    if (reply && asked_.size() >= MOST_ASKED) return reply("too many commands are waiting");
    asked_.push_back({std::move(command), std::move(reply)});
    has_news_ = true;
  }
  asked_anything_.notify_one();
}

void Session::want_frame() {
  {
    const std::lock_guard lock(mutex_);
    wants_frame_ = true;
    has_news_ = true;
  }
  asked_anything_.notify_one();
}

void Session::on_frame(std::function<void()> told) {
  const std::lock_guard lock(mutex_);
  told_ = std::move(told);
}

// --- the run ----------------------------------------------------------------------------------

void Session::begin(machine::Machine& machine, const observe::ControlPanel& view) {
  machine_ = &machine;
  view_ = view;
  // a program may simulate several machines, one after the other
  if (phase_ == Phase::over) phase_ = Phase::running;
  next_s_ = pace_from_s_ = spans_from_s_ = 0;
  pace_since_ = HostClock::now();
  loads_ = {};
  history_.clear_samples();
  selected_.clear();
  observe(true);
  {
    auto outline = make_outline(file_, machine, view_);
    const std::lock_guard lock(mutex_);
    outline_ = std::make_shared<const ordered_json>(std::move(outline));
  }
  set_pace(speed_);
  make_frame();
}

bool Session::before(double date) {
  // stops observing processors' activity if there is more than pages can draw
  if (spans_.is_cut() && is_observing_) observe(false);
  // The simulated user leaves when the picture is complete, whether or not a page is connected.
  const bool is_complete = !has_left_ && view_.is_complete && view_.is_complete();
  const bool is_quiet = !is_complete && !has_news_.load(std::memory_order_relaxed) &&
                        phase_ == Phase::running && !goal_ && date < go_until_s_ &&
                        ++calls_ % CALLS_BETWEEN != 0;
  return is_quiet || attend(date);
}

// Executes commands, makes frames and keeps the set speed, before the event at simulated time
// `date`. Returns the result of before().
bool Session::attend(double date) {
  const std::size_t actions = actions_.size();
  next_s_ = date;
  for (;;) {
    if (was_interrupted()) end_by_hand();
    obey_all();
    if (ended_by_hand_s_) return true;
    if (view_.is_complete && view_.is_complete()) leave();
    if (actions_.size() != actions) return false;
    if (follow_goal(date)) {  // neither an event nor an order is left
      leave();
      return actions_.size() == actions;
    }
    if (phase_ == Phase::running && HostClock::now() >= next_sample_at_) take_sample();
    show();
    const auto rest = hold_back(date);
    if (rest <= HostClock::duration::zero()) return true;
    std::unique_lock lock(mutex_);
    asked_anything_.wait_for(lock, rest, [this] { return has_news_.load(); });
  }
}

// Pauses the run if its goal is reached, or if it can only continue after an order of the user.
// Returns true if neither an event nor an order is left.
bool Session::follow_goal(double date) {
  if (phase_ == Phase::running && goal_ && is_reached(date)) {
    change_phase(Phase::paused);
    pace_from_s_ = std::max(machine_->now().value, std::min(goal_->date, date));
    goal_.reset();
  }
  const bool is_idle = date == NEVER, waits = waits_for_user(is_idle);
  if (phase_ == Phase::waiting && !waits) change_phase(Phase::running);
  if (phase_ != Phase::running) return false;
  if (!waits) return is_idle;
  change_phase(Phase::waiting);
  goal_.reset();
  set_pace(speed_);
  return false;
}

// Makes a frame if a page wants one, something has changed, and the last frame is old enough.
void Session::show() {
  bool is_due = false;
  {
    const std::lock_guard lock(mutex_);
    is_new_ |= phase_ == Phase::running;
    is_due = is_new_ && wants_frame_ && HostClock::now() >= next_frame_at_;
    if (is_due) is_new_ = wants_frame_ = false;
    has_news_ = !asked_.empty();
  }
  if (is_due) make_frame();
}

// If the set speed forbids the event at `date` for now, returns the host time to wait before the
// next attempt. Otherwise returns zero, and sets `go_until_s_`, the time up to which no event need
// be checked again.
Session::HostClock::duration Session::hold_back(double date) {
  if (phase_ != Phase::running) return LOOK_EVERY;
  if (goal_ || std::isinf(speed_)) {
    go_until_s_ = NEVER;
    return {};
  }
  double allowed_s = paced_s();
  if (date <= allowed_s) {
    // if the host is too slow for the set speed, forgives the lag
    if (allowed_s - date > MOST_ARREARS_S * speed_) {
      set_pace(speed_);
      allowed_s = date;
    }
    go_until_s_ = allowed_s;
    return {};
  }
  const std::chrono::duration<double> left((date - allowed_s) / speed_);
  if (left >= LOOK_EVERY) return LOOK_EVERY;
  return std::max<HostClock::duration>(std::chrono::duration_cast<HostClock::duration>(left), 1ns);
}

void Session::change_phase(Phase phase) {
  phase_ = phase;
  const std::lock_guard lock(mutex_);
  is_new_ = true;
}

// True if the machine's state can change only after an order of the user, and no simulated time
// needs to pass before the order: the run is unpaced, or no event is left.
bool Session::waits_for_user(bool is_idle) const {
  if (!view_.waits_for_user || !view_.waits_for_user()) return false;
  const bool is_endless = goal_ ? goal_->is_endless() : std::isinf(speed_);
  return is_idle || is_endless;
}

// Executes all queued commands of the pages. A refused command has no effect.
void Session::obey_all() {
  std::deque<Asked> asked;
  {
    const std::lock_guard lock(mutex_);
    asked.swap(asked_);
    is_new_ |= !asked.empty();
  }
  for (auto& [command, reply] : asked) {
    std::string refusal;
    try {
      obey(command);
    } catch (const base::BadInput& error) {
      refusal = error.what();
    }
    if (reply) reply(refusal);
  }
}

bool Session::is_reached(double date) {
  if (goal_->is_next_date) {  // goal: execute all events at the time of the next event
    goal_->is_next_date = false;
    goal_->date = date;
    return false;
  }
  if (goal_->is_message && count_messages() > goal_->messages) return true;
  if (goal_->is_ray && view_.count_rays() > goal_->rays) return true;
  if (goal_->is_picture && *view_.picture->rgb8() != *goal_->picture) return true;
  return date > goal_->date;
}

// --- the clock --------------------------------------------------------------------------------

// From now on, lets simulated time pass at `speed` times real time.
void Session::set_pace(double speed) {
  const double now_s = shown_s();
  speed_ = speed;
  pace_from_s_ = now_s;
  pace_since_ = HostClock::now();
  go_until_s_ = 0;
}

// The simulated time that the set speed permits at present, in seconds.
double Session::paced_s() const {
  const std::chrono::duration<double> since = HostClock::now() - pace_since_;
  return pace_from_s_ + since.count() * speed_;
}

// The simulated time that pages show: the time that the set speed permits, but at most the time of
// the next event.
double Session::shown_s() const {
  const double now_s = machine_->now().value;
  if (phase_ == Phase::over) return now_s;
  const bool is_paced = phase_ != Phase::paused && !goal_ && !std::isinf(speed_);
  return std::max(now_s, is_paced ? std::min(next_s_, paced_s()) : pace_from_s_);
}

// --- display ------------------------------------------------------------------------------------

std::shared_ptr<const std::vector<std::uint8_t>> Session::look() {
  if (!view_.picture) return nullptr;
  const auto& now = *view_.picture->rgb8();
  const auto last = frame();
  if (last && last->rgb8 && *last->rgb8 == now) return last->rgb8;
  return std::make_shared<const std::vector<std::uint8_t>>(now);
}

// The root mean square difference from the sequential picture, as a share of the range of pixel
// values; NaN if there is no sequential picture.
double Session::picture_error() const {
  std::shared_ptr<const std::vector<std::uint8_t>> sequential;
  {
    const std::lock_guard lock(mutex_);
    sequential = sequential_;
  }
  if (!sequential || !view_.picture) return NAN;
  const auto& now = *view_.picture->rgb8();
  std::uint64_t squares = 0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    const int off = now[i] - (*sequential)[i];
    squares += static_cast<std::uint64_t>(off * off);
  }
  return std::sqrt(static_cast<double>(squares) / static_cast<double>(now.size())) / 255;
}

// Adds the program's gauges, the loads and the picture's error to the growth curves.
void Session::take_sample() {
  next_sample_at_ = HostClock::now() + SAMPLE_EVERY;
  const double now_s = shown_s();
  loads_.update(*machine_, now_s);
  std::vector<double> values;
  for (const auto& gauge : view_.gauges) values.push_back(gauge.value());
  values.insert(values.end(), {loads_.mean_cpu(), loads_.max_link(), picture_error()});
  history_.add_sample(now_s, std::move(values));
}

void Session::make_frame() {
  const bool is_fast = phase_ == Phase::running && (goal_ || std::isinf(speed_));
  if (is_fast) next_frame_at_ = HostClock::now() + FRAMES_AT_FULL_SPEED;
  constexpr std::string_view NAMES[] = {"running", "paused", "waiting", "over"};
  auto made = std::make_shared<Frame>();
  made->number = ++frames_;
  take_sample();
  const double now_s = shown_s();
  made->state = {{"t_s", now_s},
                 {"state", NAMES[static_cast<int>(phase_)]},
                 {"phase", view_.phase ? view_.phase() : ""},
                 {"speed", std::isinf(speed_) ? ordered_json() : ordered_json(speed_)},
                 {"events", machine_->events()},
                 {"deeds", actions_.size()}};
  auto gauges = ordered_json::array();
  for (const auto& gauge : view_.gauges) gauges.push_back(gauge.value());
  made->state["gauges"] = gauges;
  made->state.update(loads_.describe(*machine_, now_s));
  if (stages_ && view_.limits) made->state["limits"] = list_limits(*stages_, view_.limits());
  made->state["spans_cut"] = spans_.is_cut();
  made->state["spans_from_s"] = std::exchange(spans_from_s_, now_s);
  made->state["spans"] = spans_.take();
  made->state["open"] = Spans::look_at(*machine_);
  if (!is_observing_) observe(true);
  auto details = ordered_json::object();
  std::set<int> selected;
  for (const auto& [page, ids] : selected_) selected.insert(ids.begin(), ids.end());
  for (const int id : selected)
    details[std::to_string(id)] =
        describe_processor(*machine_->processors()[static_cast<std::size_t>(id)], view_);
  made->state["details"] = details;
  if (!fault_.empty()) made->state["fault"] = fault_;
  if (!fault_.empty() && !has_thrown_) made->state["deadlock"] = describe_deadlock(*machine_);
  made->rgb8 = look();
  std::function<void()> told;
  {
    const std::lock_guard lock(mutex_);
    made->sequential = sequential_;
    frame_ = std::move(made);
    told = told_;
  }
  if (told) told();
}

void Session::observe(bool is_told) {
  is_observing_ = is_told;
  machine_->set_observer(is_told ? &spans_ : nullptr);
}

std::uint64_t Session::count_messages() const {
  std::uint64_t messages = 0;
  for (const auto& link : machine_->links()) messages += link->use().messages;
  return messages;
}

// --- the end ----------------------------------------------------------------------------------

void Session::end_by_hand() {
  if (!machine_ || ended_by_hand_s_) return;
  ended_by_hand_s_ = machine_->now().value;
  machine_->stop();
}

void Session::end(const std::string& fault) {
  if (renders_.joinable()) {  // the rendering uses data of the machine, which ends now
    renders_.request_stop();
    renders_.join();
  }
  pace_from_s_ = machine_->now().value;
  phase_ = Phase::over;
  goal_.reset();
  fault_ = fault;
  // If the user ended the run by hand, records an order to leave at the end, so that the recording
  // is a valid experiment.
  if (ended_by_hand_s_ && orders_ && view_.take_order && !has_left_ && !has_leave(file_))
    actions_.push_back({"order", LATEST_S, {{"leave", "true"}}});
  // After an exception in a process, pages get no description of a deadlock or of processors.
  has_thrown_ = std::ranges::any_of(machine_->processors(),
                                    [](const auto& on) { return on->failure() != nullptr; });
  selected_.clear();
  // keeps all processors, since pages may select some after the machine is gone
  if (!has_thrown_) {
    auto& all = selected_[0];
    all.resize(std::min(MOST_TOLD_AT_END, machine_->processors().size()));
    std::iota(all.begin(), all.end(), 0);
  }
  make_frame();
  machine_ = nullptr;
  view_ = {};
}

void Session::say_results(const std::string& text) {
  std::function<void()> told;
  {
    const std::lock_guard lock(mutex_);
    auto made = std::make_shared<Frame>(frame_ ? *frame_ : Frame());
    made->number = ++frames_;
    made->state["results"] = text;
    frame_ = std::move(made);
    told = told_;
  }
  if (told) told();
}

void Session::wait_for_quit() {
  for (;;) {
    obey_all();
    std::unique_lock lock(mutex_);
    if (is_quitting_ || was_interrupted()) return;
    wants_frame_ = false;
    has_news_ = !asked_.empty();
    asked_anything_.wait_for(lock, LOOK_EVERY, [this] { return has_news_.load(); });
  }
}

}  // namespace laboratory
