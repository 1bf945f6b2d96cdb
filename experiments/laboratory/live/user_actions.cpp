#include "experiments/laboratory/live/user_actions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/errors.hpp"
#include "experiments/laboratory/points/run_point.hpp"

namespace laboratory {

using nlohmann::ordered_json;

namespace {

// Time grid, in seconds. Orders take effect at whole multiples of it, and faults halfway between
// two multiples. Thus no order and fault happen at the same time.
constexpr double FAULT_GRID_S = 1e-6;

base::Scalar to_scalar(const std::string& key, const ordered_json& value) {
  if (value.is_boolean()) return value.get<bool>();
  if (value.is_number_unsigned() && value.get<std::uint64_t>() > std::uint64_t{INT64_MAX})
    return value.get<double>();
  if (value.is_number_integer()) return value.get<std::int64_t>();
  if (value.is_number()) return value.get<double>();
  if (value.is_string()) return value.get<std::string>();
  base::require(value.is_array() && value.size() <= 16, key,
                "found {}, expected a number, a text, true or false, or a short list",
                value.type_name());
  std::vector<double> list;
  for (const auto& number : value) {
    base::require(number.is_number(), key, "found {} in a list, expected numbers",
                  number.type_name());
    list.push_back(number.get<double>());
  }
  return list;
}

ordered_json to_json(const base::Scalar& value) {
  return std::visit(
      [](const auto& known) -> ordered_json {
        using Known = std::decay_t<decltype(known)>;
        if constexpr (std::same_as<Known, std::monostate>)
          return {};
        else if constexpr (std::same_as<Known, base::Source>)
          return known.text;
        else
          return known;
      },
      value);
}

// Converts an order from a page to a record of the program's list `list`.
std::any read_order(const programs::RecordList& list, const ordered_json& order) {
  base::require(order.is_object(), "order", "found {}, expected an object", order.type_name());
  auto record = list.make_record();
  for (const auto& [key, value] : order.items()) {
    const auto field = std::ranges::find(list.fields, key, &programs::Parameter::name);
    base::require(field != list.fields.end() && key != "at_s", "order",
                  "found the key \"{}\", expected a key of [[order]] other than at_s", key);
    const auto expected = field->assign(record, to_scalar(key, value));
    base::require(expected.empty(), "order." + key, "found {}, expected {}", value.dump(),
                  expected);
  }
  return record;
}

// Converts an order from a page to the form of the experiment file.
UserAction make_action(double at_s, const ordered_json& order) {
  UserAction action{"order", at_s, {}};
  // JSON and TOML spell numbers, lists, strings and booleans in the same way.
  for (const auto& [key, value] : order.items()) action.keys.emplace_back(key, value.dump());
  return action;
}

// True if the experiment file has an [[order]] with which the simulated user leaves.
bool has_leave(const ExperimentFile& file) {
  const auto* orders = (*file.content)["order"].as_array();
  return orders && std::any_of(orders->begin(), orders->end(), [](const toml::node& order) {
           return order.is_table() && (*order.as_table())["leave"].value_or(false);
         });
}

}  // namespace

bool is_index(const ordered_json& value, std::size_t size) {
  if (!value.is_number_integer()) return false;
  return value.get<std::int64_t>() >= 0 && value.get<std::uint64_t>() < size;
}

UserActions::UserActions(const ExperimentFile& file, History& history)
    : file_(file),
      history_(history),
      orders_(file.points.at(0).experiment.program->find_list("order")),
      faults_(file.points[0].experiment.faults) {}

void UserActions::begin(machine::Machine& machine, const observe::ControlPanel& view) {
  machine_ = &machine;
  view_ = view;
}

void UserActions::end(bool by_hand) {
  if (by_hand && orders_ && view_.take_order && !has_left_ && !has_leave(file_))
    all_.push_back({"order", LATEST_S, {{"leave", "true"}}});
  machine_ = nullptr;
  view_ = {};
}

void UserActions::order(const ordered_json& order, double now_s) {
  base::require(orders_ && view_.take_order, "order",
                "found one, but the program {} has no user process",
                file_.points[0].experiment.program->name);
  const auto record = read_order(*orders_, order);
  const double at_s = view_.take_order(record, {now_s});
  history_.add_action({{"t_s", now_s}, {"order", order}});
  all_.push_back(make_action(at_s, order));
  has_left_ |= order.contains("leave");
}

void UserActions::save(double now_s) {
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
           std::ranges::any_of(all_, is_action);
  };
  int number = 1;
  while (is_taken(fmt::format("live{}", number))) ++number;
  order({{"save", fmt::format("live{}", number)}}, now_s);
}

void UserActions::leave(double now_s) {
  if (!orders_ || !view_.take_order || has_left_) return;
  try {
    order({{"leave", true}}, now_s);
    // the simulated user does not run yet, or the file has an order at a later time
  } catch (const base::BadInput&) {
    view_.close_orders();
    has_left_ = true;
  }
}

void UserActions::fault(const ordered_json& fault, double now_s) {
  const auto& program = *file_.points[0].experiment.program;
  base::require(program.uses.faults, "fault",
                "found one, but the program {} does not support faults", program.name);
  const double after_s = std::max(now_s, fault_after_s_);
  const double at_s = (std::floor(after_s / FAULT_GRID_S) + 1.5) * FAULT_GRID_S;
  const char* what = fault.contains("link") ? "link" : "processor";
  const auto where = fault.contains("link")
                         ? cut_link(fault["link"], at_s)
                         : stop_processor(fault.value("processor", ordered_json()), at_s);
  history_.add_action({{"t_s", at_s}, {what, fault[what]}});
  fault_after_s_ = at_s;
  all_.push_back({"fault", at_s, {{what, where}}});
}

// Cuts a link, and returns its processors as TOML spells them.
std::string UserActions::cut_link(const ordered_json& link, double at_s) {
  base::require(link.is_array() && link.size() == 2, "link", "expected two processors");
  const auto [a, a_number] = find_processor(link[0]);
  const auto [b, b_number] = find_processor(link[1]);
  auto& from = *machine_->processors()[static_cast<std::size_t>(a)];
  auto& to = *machine_->processors()[static_cast<std::size_t>(b)];
  const bool is_there = std::ranges::any_of(machine_->links(), [&](const auto& direction) {
    return &direction->from() == &from && &direction->to() == &to;
  });
  base::require(is_there, "link",
                "found {} and {}, expected two processors that are joined by a link", from.name(),
                to.name());
  check_with({.at_s = at_s, .a = a_number, .b = b_number});
  machine_->cut_link(from, to, {at_s});
  return fmt::format("[{}, {}]", a_number, b_number);
}

std::string UserActions::stop_processor(const ordered_json& processor, double at_s) {
  const auto [id, number] = find_processor(processor);
  check_with({.at_s = at_s, .a = number});
  machine_->stop_processor(*machine_->processors()[static_cast<std::size_t>(id)], {at_s});
  return std::to_string(number);
}

// Checks the experiment with one more fault, and keeps the fault.
void UserActions::check_with(const programs::PlannedFault& planned) {
  Experiment experiment = file_.points[0].experiment;
  experiment.faults = faults_;
  experiment.faults.push_back({planned, "the fault"});
  check_point(experiment);
  faults_ = std::move(experiment.faults);
}

// Finds a processor: its id in the machine, and its number in the network.
std::pair<int, int> UserActions::find_processor(const ordered_json& id) const {
  const auto& processors = machine_->processors();
  base::require(is_index(id, processors.size()), "fault",
                "found {}, expected a processor from 0 to {}", id.dump(), processors.size() - 1);
  const int number = id.get<int>();
  const auto& network = view_.network;
  if (network.empty()) return {number, number};
  const auto place = std::ranges::find(network, number);
  base::require(place != network.end(), "fault", "found {}, expected a processor of the network",
                processors[static_cast<std::size_t>(number)]->name());
  return {number, static_cast<int>(place - network.begin())};
}

ordered_json describe_limits(const programs::RecordList& stages) {
  using Kind = base::Domain::Kind;
  auto limits = ordered_json::array();
  for (const auto& field : stages.fields) {
    const bool is_number = field.domain.kind == Kind::number || field.domain.kind == Kind::whole;
    ordered_json limit = {{"name", field.name},
                          {"help", field.help},
                          {"unit", field.unit},
                          {"whole", field.domain.kind == Kind::whole},
                          {"expected", field.domain.describe()}};
    if (is_number) limit["range"] = {field.domain.low, field.domain.high};
    limits.push_back(std::move(limit));
  }
  return limits;
}

ordered_json list_limits(const programs::RecordList& stages, const std::any& limits) {
  auto values = ordered_json::array();
  for (const auto& field : stages.fields) values.push_back(to_json(field.get(limits)));
  return values;
}

}  // namespace laboratory
