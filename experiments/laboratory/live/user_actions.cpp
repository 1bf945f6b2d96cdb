#include "experiments/laboratory/live/user_actions.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/errors.hpp"

namespace laboratory {

using nlohmann::ordered_json;

namespace {

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

}  // namespace

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

UserAction make_action(double at_s, const ordered_json& order) {
  UserAction action{"order", at_s, {}};
  // JSON and TOML spell numbers, lists, strings and booleans in the same way.
  for (const auto& [key, value] : order.items()) action.keys.emplace_back(key, value.dump());
  return action;
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
