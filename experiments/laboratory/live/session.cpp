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
// number of events between two checks for commands while the machine runs
constexpr std::uint64_t CALLS_BETWEEN = 1024;
// limit on processors that pages can still inspect after the end of the run
constexpr std::size_t MOST_TOLD_AT_END = 256;

}  // namespace

Session::Session(const ExperimentFile& file, double speed)
    : file_(file),
      stages_(file.points.at(0).experiment.program->find_list("stage")),
      actions_(file, history_),
      pacer_(speed) {}

// --- the run ----------------------------------------------------------------------------------

void Session::begin(machine::Machine& machine, const observe::ControlPanel& view) {
  machine_ = &machine;
  view_ = view;
  actions_.begin(machine, view);
  // a program may simulate several machines, one after the other
  if (phase_ == Phase::over) phase_ = Phase::running;
  next_s_ = spans_from_s_ = 0;
  loads_ = {};
  history_.clear_samples();
  selected_.clear();
  observe(true);
  publish_outline(make_outline(file_, machine, view_));
  pacer_.start(machine.now().value, pacer_.speed());
  make_frame();
}

bool Session::before(double date) {
  // stops observing processors' activity if there is more than pages can draw
  if (spans_.is_cut() && is_observing_) observe(false);
  // The simulated user leaves when the picture is complete, whether or not a page is connected.
  const bool is_complete = !actions_.has_left() && view_.is_complete && view_.is_complete();
  const bool is_quiet = !is_complete && !has_news() && phase_ == Phase::running && !goal_ &&
                        pacer_.is_free(date) && ++calls_ % CALLS_BETWEEN != 0;
  return is_quiet || attend(date);
}

// Executes commands, makes frames and keeps the set speed, before the event at simulated time
// `date`. Returns the result of before().
bool Session::attend(double date) {
  const std::size_t actions = actions_.all().size();
  next_s_ = date;
  for (;;) {
    if (was_interrupted()) end_by_hand();
    obey_all();
    if (ended_by_hand_s_) return true;
    if (view_.is_complete && view_.is_complete()) actions_.leave(shown_s());
    if (actions_.all().size() != actions) return false;
    if (follow_goal(date)) {  // neither an event nor an order is left
      actions_.leave(shown_s());
      return actions_.all().size() == actions;
    }
    if (phase_ == Phase::running && HostClock::now() >= next_sample_at_) take_sample();
    show();
    const auto rest = hold_back(date);
    if (rest <= HostClock::duration::zero()) return true;
    wait_for_news(rest);
  }
}

// Pauses the run if its goal is reached, or if it can only continue after an order of the user.
// Returns true if neither an event nor an order is left.
bool Session::follow_goal(double date) {
  if (phase_ == Phase::running && goal_ && is_reached(date)) {
    change_phase(Phase::paused);
    pacer_.set_time(std::max(machine_->now().value, std::min(goal_->date, date)));
    goal_.reset();
  }
  const bool is_idle = date == NEVER, waits = waits_for_user(is_idle);
  if (phase_ == Phase::waiting && !waits) change_phase(Phase::running);
  if (phase_ != Phase::running) return false;
  if (!waits) return is_idle;
  change_phase(Phase::waiting);
  goal_.reset();
  set_pace(pacer_.speed());
  return false;
}

// Makes a frame if a page wants one, something has changed, and the last frame is old enough.
void Session::show() {
  if (phase_ == Phase::running) note_change();
  if (HostClock::now() >= next_frame_at_ && take_request()) make_frame();
}

// If the event at `date` may not happen for now, returns the host time to wait before the next
// attempt. Otherwise returns zero.
Session::HostClock::duration Session::hold_back(double date) {
  if (phase_ != Phase::running) return LOOK_EVERY;
  if (!goal_ && !pacer_.is_unlimited()) return pacer_.hold_back(date, LOOK_EVERY);
  pacer_.set_free();
  return {};
}

void Session::change_phase(Phase phase) {
  phase_ = phase;
  note_change();
}

// True if the machine's state can change only after an order of the user, and no simulated time
// needs to pass before the order: the run is unpaced, or no event is left.
bool Session::waits_for_user(bool is_idle) const {
  if (!view_.waits_for_user || !view_.waits_for_user()) return false;
  const bool is_endless = goal_ ? goal_->is_endless() : pacer_.is_unlimited();
  return is_idle || is_endless;
}

// Executes all queued commands of the pages. A refused command has no effect.
void Session::obey_all() {
  for (const auto& [command, reply] : take_commands()) {
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

void Session::set_pace(double speed) { pacer_.start(shown_s(), speed); }

// The simulated time that pages show: the time that the set speed permits, but at most the time of
// the next event.
double Session::shown_s() const {
  const double now_s = machine_->now().value;
  if (phase_ == Phase::over) return now_s;
  const bool is_paced = phase_ != Phase::paused && !goal_ && !pacer_.is_unlimited();
  return std::max(now_s, is_paced ? std::min(next_s_, pacer_.paced_s()) : pacer_.from_s());
}

// --- display ------------------------------------------------------------------------------------

Rgb8 Session::look() {
  if (!view_.picture) return nullptr;
  const auto& now = *view_.picture->rgb8();
  const auto last = frame();
  if (last && last->rgb8 && *last->rgb8 == now) return last->rgb8;
  return std::make_shared<const std::vector<std::uint8_t>>(now);
}

// The root mean square difference from the sequential picture, as a share of the range of pixel
// values; NaN if there is no sequential picture.
double Session::picture_error() const {
  const auto sequential = this->sequential();
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
  const bool is_fast = phase_ == Phase::running && (goal_ || pacer_.is_unlimited());
  if (is_fast) next_frame_at_ = HostClock::now() + FRAMES_AT_FULL_SPEED;
  constexpr std::string_view NAMES[] = {"running", "paused", "waiting", "over"};
  auto made = std::make_shared<Frame>();
  take_sample();
  const double now_s = shown_s();
  made->state = {{"t_s", now_s},
                 {"state", NAMES[static_cast<int>(phase_)]},
                 {"phase", view_.phase ? view_.phase() : ""},
                 {"speed", pacer_.is_unlimited() ? ordered_json() : ordered_json(pacer_.speed())},
                 {"events", machine_->events()},
                 {"deeds", actions_.all().size()}};
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
  publish(std::move(made));
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
  pacer_.set_time(machine_->now().value);
  phase_ = Phase::over;
  goal_.reset();
  fault_ = fault;
  actions_.end(ended_by_hand_s_.has_value());
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
  const auto last = frame();
  auto made = last ? std::make_shared<Frame>(*last) : std::make_shared<Frame>();
  made->state["results"] = text;
  publish(std::move(made));
}

void Session::wait_for_quit() {
  for (obey_all(); !is_quitting_ && !was_interrupted(); obey_all()) wait_for_news(LOOK_EVERY);
}

}  // namespace laboratory
