// Execution of the commands that pages send to a session.
#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"
#include "experiments/laboratory/live/session.hpp"

namespace laboratory {

using nlohmann::ordered_json;

namespace {

constexpr std::size_t MOST_SELECTED = 8;  // limit on processors that one page can select

double number_at(const ordered_json& command, const char* key, double low, double high) {
  base::require(command.contains(key) && command[key].is_number(), key, "expected a number");
  const double value = command[key].get<double>();
  base::require(value >= low && value <= high, key, "found {}, expected {} to {}", value, low,
                high);
  return value;
}

// Reads the speed in a command, in simulated seconds per host second; null stands for as fast as
// possible.
double speed_at(const ordered_json& command) {
  if (command.contains("x") && command["x"].is_null())
    return std::numeric_limits<double>::infinity();
  return number_at(command, "x", 1e-9, 1e9);
}

std::string text_at(const ordered_json& command, const char* key) {
  base::require(command.is_object() && command.contains(key) && command[key].is_string(), key,
                "expected a text");
  return command[key].get<std::string>();
}

}  // namespace

void Session::obey(const Command& command) {
  using Obey = void (*)(Session&, const Command&);
  static const std::pair<const char*, Obey> COMMANDS[] = {
      {"pause", [](Session& on, const Command&) { on.pause(); }},
      {"go", [](Session& on, const Command&) { on.go(); }},
      {"speed", [](Session& on, const Command& x) { on.set_pace(speed_at(x)); }},
      {"step", [](Session& on, const Command& x) { on.step(text_at(x, "what")); }},
      {"run", [](Session& on, const Command& x) { on.run_to(x); }},
      {"order",
       [](Session& on, const Command& x) {
         on.actions_.order(x.value("order", Command()), on.shown_s());
       }},
      {"save", [](Session& on, const Command&) { on.actions_.save(on.shown_s()); }},
      {"fault", [](Session& on, const Command& x) { on.actions_.fault(x, on.shown_s()); }},
      {"compare", [](Session& on, const Command&) { on.render_sequentially(); }},
      {"end", [](Session& on, const Command&) { on.end_by_hand(); }},
      {"interval",
       [](Session& on, const Command& x) { on.loads_.set_interval(number_at(x, "s", 0, 1e9)); }},
      {"select", [](Session& on, const Command& x) { on.select(x); }},
      {"quit", [](Session& on, const Command&) { on.quit(); }}};
  const auto what = text_at(command, "do");
  const auto* found =
      std::ranges::find(COMMANDS, what, [](const auto& known) { return known.first; });
  if (found == std::end(COMMANDS)) {
    std::string names = "steer";  // obeyed by the server of the pages
    for (const auto& [name, obey] : COMMANDS) names += fmt::format(", {}", name);
    base::refuse("do", "found \"{}\", expected one of {}", what, names);
  }
  base::require(what == "quit" || (machine_ && !ended_by_hand_s_), "do",
                "found {} after the end of the run, expected it earlier", what);
  found->second(*this, command);
}

void Session::pause() {
  if (phase_ == Phase::paused) return;
  pacer_.set_time(shown_s());
  phase_ = Phase::paused;
  goal_.reset();
}

void Session::go() {
  const double from_s = shown_s();  // before the end of the pause, which is not simulated time
  goal_.reset();
  if (phase_ == Phase::paused) phase_ = Phase::running;
  pacer_.start(from_s, pacer_.speed());
}

void Session::quit() {
  is_quitting_ = true;
  end_by_hand();
}

void Session::select(const Command& command) {
  base::require(command.contains("processors") && command["processors"].is_array() &&
                    command["processors"].size() <= MOST_SELECTED,
                "processors", "expected a list of at most {}", MOST_SELECTED);
  std::vector<int> selected;
  for (const auto& id : command["processors"]) {
    base::require(is_index(id, machine_->processors().size()), "processors",
                  "found {}, expected numbers from 0 to {}", id.dump(),
                  machine_->processors().size() - 1);
    selected.push_back(id.get<int>());
  }
  const auto page = command.value("page", std::uint64_t{0});
  if (selected.empty())
    selected_.erase(page);
  else
    selected_[page] = selected;
}

void Session::set_goal(const Goal& goal) {
  pacer_.set_time(shown_s());
  goal_ = goal;
  phase_ = Phase::running;
}

void Session::step(const std::string& what) {
  Goal goal;
  goal.messages = count_messages();
  if (what == "event") {
    goal.is_next_date = true;
  } else if (what == "message") {
    goal.is_message = true;
  } else if (what == "ray") {
    base::require(view_.count_rays != nullptr, "step", "found ray, but the program traces no rays");
    goal.is_ray = true;
    goal.rays = view_.count_rays();
  } else if (what == "millisecond") {
    goal.date = shown_s() + 1e-3;
  } else {
    base::refuse("what", "found \"{}\", expected event, message, ray or millisecond", what);
  }
  set_goal(goal);
}

void Session::run_to(const Command& command) {
  Goal goal;
  base::require(command.contains("to"), "to", "expected a time in s, \"picture\" or \"end\"");
  const auto& to = command["to"];
  if (to == "picture") {
    base::require(view_.picture.has_value(), "to",
                  "found picture, but the program shows no picture");
    goal.is_picture = true;
    goal.picture = look();
  } else if (to != "end") {
    goal.date = number_at(command, "to", 0, LATEST_S);
  }
  set_goal(goal);
}

// Renders the picture sequentially in a separate thread, while the simulation continues.
void Session::render_sequentially() {
  base::require(view_.sequential != nullptr, "compare",
                "found one, but the program has no sequential renderer for comparison");
  if (renders_.joinable()) return;
  renders_ = std::jthread([this, render = view_.sequential](const std::stop_token& stop) {
    auto rgb8 = render([&stop] { return !stop.stop_requested(); });
    if (!rgb8.empty())
      set_sequential(std::make_shared<const std::vector<std::uint8_t>>(std::move(rgb8)));
  });
}

}  // namespace laboratory
