// Execution of the commands that pages send to a session.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "experiments/laboratory/live/session.hpp"
#include "experiments/laboratory/points/run_point.hpp"

namespace laboratory {

using nlohmann::ordered_json;

namespace {

constexpr std::size_t MOST_SELECTED = 8;  // limit on processors that one page can select
// Time grid, in seconds. Orders take effect at whole multiples of it, and faults halfway between
// two multiples. Thus no order and fault happen at the same time.
constexpr double FAULT_GRID_S = 1e-6;

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

bool is_index(const ordered_json& value, std::size_t size) {
  if (!value.is_number_integer()) return false;
  return value.get<std::int64_t>() >= 0 && value.get<std::uint64_t>() < size;
}

// Finds a processor: its id in the machine, and its number in the network.
std::pair<int, int> find_processor(const machine::Machine& machine, const std::vector<int>& network,
                                   const ordered_json& id) {
  const auto& processors = machine.processors();
  base::require(is_index(id, processors.size()), "fault",
                "found {}, expected a processor from 0 to {}", id.dump(), processors.size() - 1);
  const int number = id.get<int>();
  if (network.empty()) return {number, number};
  const auto place = std::ranges::find(network, number);
  base::require(place != network.end(), "fault", "found {}, expected a processor of the network",
                processors[static_cast<std::size_t>(number)]->name());
  return {number, static_cast<int>(place - network.begin())};
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
      {"order", [](Session& on, const Command& x) { on.obey_order(x.value("order", Command())); }},
      {"save", [](Session& on, const Command&) { on.save(); }},
      {"fault", [](Session& on, const Command& x) { on.obey_fault(x); }},
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
    std::string names;
    for (const auto& [name, obey] : COMMANDS)
      names += names.empty() ? name : fmt::format(", {}", name);
    base::refuse("do", "found \"{}\", expected one of {}", what, names);
  }
  base::require(what == "quit" || (machine_ && !ended_by_hand_s_), "do",
                "found {} after the end of the run, expected it earlier", what);
  found->second(*this, command);
}

void Session::pause() {
  if (phase_ == Phase::paused) return;
  pace_from_s_ = shown_s();
  phase_ = Phase::paused;
  goal_.reset();
}

void Session::go() {
  goal_.reset();
  if (phase_ == Phase::paused) phase_ = Phase::running;
  set_pace(speed_);
}

void Session::quit() {
  const std::lock_guard lock(mutex_);
  is_quitting_ = true;
  end_by_hand();
}

// Saves the current picture. Its file name is the first of live1, live2, ... that is not used yet.
void Session::save() {
  const auto* orders = (*file_.content)["order"].as_array();
  const auto is_taken = [&](const std::string& name) {
    const auto is_in_file = [&](const toml::node& order) {
      return order.is_table() && (*order.as_table())["save"].value<std::string>() == name;
    };
    const auto is_action = [&](const UserAction& action) {
      return std::ranges::any_of(action.keys, [&](const auto& key) {
        return key.first == "save" && key.second == fmt::format("\"{}\"", name);
      });
    };
    return (orders && std::any_of(orders->begin(), orders->end(), is_in_file)) ||
           std::ranges::any_of(actions_, is_action);
  };
  int number = 1;
  while (is_taken(fmt::format("live{}", number))) ++number;
  obey_order({{"save", fmt::format("live{}", number)}});
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

void Session::obey_order(const Command& order) {
  base::require(orders_ && view_.take_order, "order",
                "found one, but the program {} has no user process",
                file_.points[0].experiment.program->name);
  const auto record = read_order(*orders_, order);
  const double at_s = view_.take_order(record, {shown_s()});
  history_.add_action({{"t_s", shown_s()}, {"order", order}});
  actions_.push_back(make_action(at_s, order));
  has_left_ |= order.contains("leave");
}

void Session::obey_fault(const Command& fault) {
  const auto& program = *file_.points[0].experiment.program;
  base::require(program.uses.faults, "fault",
                "found one, but the program {} does not support faults", program.name);
  const auto find = [&](const ordered_json& id) {
    return find_processor(*machine_, view_.network, id);
  };
  const double after_s = std::max(shown_s(), fault_after_s_);
  const double at_s = (std::floor(after_s / FAULT_GRID_S) + 1.5) * FAULT_GRID_S;
  const auto check_with = [&](const programs::PlannedFault& planned) {
    Experiment experiment = file_.points[0].experiment;
    experiment.faults = faults_;
    experiment.faults.push_back({planned, "the fault"});
    check_point(experiment);
    faults_ = std::move(experiment.faults);
  };
  const auto at = [&](int id) -> auto& {
    return *machine_->processors()[static_cast<std::size_t>(id)];
  };
  UserAction action{"fault", at_s, {}};
  if (fault.contains("link")) {
    const auto& link = fault["link"];
    base::require(link.is_array() && link.size() == 2, "link", "expected two processors");
    const auto [a, a_number] = find(link[0]);
    const auto [b, b_number] = find(link[1]);
    const bool is_there = std::ranges::any_of(machine_->links(), [&, a = a, b = b](const auto& l) {
      return l->from().id() == a && l->to().id() == b;
    });
    base::require(is_there, "link",
                  "found {} and {}, expected two processors that are joined by a link",
                  at(a).name(), at(b).name());
    check_with({.at_s = at_s, .a = a_number, .b = b_number});
    machine_->cut_link(at(a), at(b), {at_s});
    action.keys.emplace_back("link", fmt::format("[{}, {}]", a_number, b_number));
  } else {
    const auto [id, number] =
        find(fault.contains("processor") ? fault["processor"] : ordered_json());
    check_with({.at_s = at_s, .a = number});
    machine_->stop_processor(at(id), {at_s});
    action.keys.emplace_back("processor", fmt::format("{}", number));
  }
  const char* what = fault.contains("link") ? "link" : "processor";
  history_.add_action({{"t_s", at_s}, {what, fault[what]}});
  fault_after_s_ = at_s;
  actions_.push_back(std::move(action));
}

// Makes the simulated user leave, because the machine would wait for this user forever. If the
// program refuses the order to leave, only closes the list of orders.
void Session::leave() {
  if (!orders_ || !view_.take_order || has_left_) return;
  try {
    obey_order({{"leave", true}});
    // the simulated user does not run yet, or the file has an order at a later time
  } catch (const base::BadInput&) {
    view_.close_orders();
    has_left_ = true;
  }
}

void Session::set_goal(const Goal& goal) {
  pace_from_s_ = shown_s();
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
    if (rgb8.empty()) return;
    const std::lock_guard lock(mutex_);
    sequential_ = std::make_shared<const std::vector<std::uint8_t>>(std::move(rgb8));
    is_new_ = true;
  });
}

}  // namespace laboratory
