// [[check]] and [let], as they stand in the file.
#include <fmt/ranges.h>

#include <cmath>

#include "base/errors.hpp"
#include "base/formula.hpp"
#include "experiments/laboratory/file/binding.hpp"
#include "experiments/laboratory/file/schema.hpp"

namespace laboratory {

namespace {

using base::BadInput;

constexpr double LARGEST = 1e300;

// An expression, or a number as the text of one.
std::string read_expression(const Place& at) {
  const auto number = at.node.is_number() ? at.node.value<double>() : std::nullopt;
  return number && std::isfinite(*number) ? fmt::format("{}", *number) : read_text(at);
}

void read_between(Check& check, const Place& at) {
  const auto* ends = at.node.as_array();
  if (!ends || ends->size() != 2) at.refuse("[lowest, highest]");
  const auto &lowest = (*ends)[0], &highest = (*ends)[1];
  if (lowest.is_number() && highest.is_number() &&
      !(*lowest.value<double>() <= *highest.value<double>()))
    at.refuse("[lowest, highest]");
  check.at_least = read_expression({at.origin, at.key, at.folder, lowest});
  check.at_most = read_expression({at.origin, at.key, at.folder, highest});
}

const std::vector<Binding<Check>>& bindings() {
  using C = Check;
  using P = Place;
  static const std::vector<Binding<C>> all = {
      {"name", "what the check is called", [](C& c, const P& at) { c.name = read_text(at); }},
      {"of", "the column of the results, or the name of [let], that is checked",
       [](C& c, const P& at) { c.of = read_text(at); }},
      {"formula", "what it should be: over columns, numbers of the file and model, and [let]",
       [](C& c, const P& at) { c.formula = read_text(at); }},
      {"reference", "or a CSV file with what it should be",
       [](C& c, const P& at) { c.reference = read_source(at).path; }},
      {"keys", "columns of both that say which row is which point",
       [](C& c, const P& at) { c.keys = read_texts(at); }},
      {"column", "the reference's column, if it is not called as `of`",
       [](C& c, const P& at) { c.column = read_text(at); }},
      {"at_least", "or the lowest value allowed, a number or an expression like `formula`",
       [](C& c, const P& at) { c.at_least = read_expression(at); }},
      {"at_most", "or the highest value allowed, a number or an expression",
       [](C& c, const P& at) { c.at_most = read_expression(at); }},
      {"between", "or both, [lowest, highest]", read_between},
      {"where", "an expression: only points where it is not 0",
       [](C& c, const P& at) { c.where = read_text(at); }},
      {"calibrated", "an expression: not 0 at points that the machine model was fitted to",
       [](C& c, const P& at) { c.calibrated = read_text(at); }},
      {"within", "largest relative error",
       [](C& c, const P& at) { c.within = read_double(at, 0, LARGEST); }},
      {"within_mean", "largest mean of the relative errors",
       [](C& c, const P& at) { c.within_mean = read_double(at, 0, LARGEST); }},
      {"within_abs", "or largest absolute error, in the unit of `of`",
       [](C& c, const P& at) { c.within_abs = read_double(at, 0, LARGEST); }},
  };
  return all;
}

// "formula and at_least": which of these keys the table has.
std::string join_given(const toml::table& table, std::vector<std::string> keys) {
  std::erase_if(keys, [&](const auto& key) { return !table.contains(key); });
  return fmt::format("{}", fmt::join(keys, " and "));
}

void check_complete(const Check& c, const toml::table& table) {
  auto expect = [&](bool holds, const std::string& what) {
    if (!holds) throw BadInput(fmt::format("{}: {}", c.place, what));
  };
  expect(!c.name.empty(), "\"name\" is missing");
  expect(!c.of.empty(), "\"of\" is missing, expected a column of the results");
  const auto kinds = join_given(table, {"formula", "reference", "at_least", "at_most", "between"});
  expect(!kinds.empty() && kinds.find(' ') == kinds.npos,
         fmt::format("found {}, expected either a formula or a reference, or at_least, at_most or "
                     "between",
                     kinds.empty() ? "none" : kinds));
  expect(
      c.reference.empty() == c.keys.empty(),
      "expected keys, columns of the results and the reference, with a reference and only there");
  expect(!c.reference.empty() || c.column.empty(), "expected no column without a reference");
  if (c.has_bounds()) {
    const auto others = join_given(table, {"within", "within_mean", "within_abs", "calibrated"});
    return expect(others.empty(),
                  fmt::format("found {} and {}, expected no tolerance of a bound", kinds, others));
  }
  expect(c.within || c.within_mean || c.within_abs,
         "expected a tolerance: within, within_mean or within_abs");
  expect(!c.within_abs || !(c.within || c.within_mean),
         "expected relative tolerances or within_abs, not both");
}

Check read_check(const toml::table& table, const Place& at) {
  Check check;
  for (auto&& [key, node] : table)
    bind_one(check, bindings(), {at.origin, std::string(key.str()), at.folder, node});
  const Place here{at.origin, "check", "", table};
  check.place = fmt::format("{}: check \"{}\"", here.where(), check.name);
  check_complete(check, table);
  if (check.column.empty()) check.column = check.of;
  return check;
}

}  // namespace

const std::vector<Setting>& check_settings() {
  static const std::vector<Setting> all = [] {
    std::vector<Setting> list;
    for (const auto& b : bindings()) list.push_back({"check." + b.key, b.help});
    return list;
  }();
  return all;
}

std::vector<Check> read_checks(const toml::table& file, const std::string& origin,
                               const std::string& folder) {
  const auto* node = file.get("check");
  if (!node || (node->is_array() && node->as_array()->empty())) return {};
  const Place at{origin, "check", folder, *node};
  std::vector<Check> checks;
  for (const auto* table : read_tables(at)) checks.push_back(read_check(*table, at));
  return checks;
}

std::vector<Definition> read_definitions(const toml::table& file, const std::string& origin) {
  const auto* node = file.get("let");
  if (!node) return {};
  if (!node->is_table()) Place{origin, "let", "", *node}.refuse("a section of names");
  std::vector<Definition> definitions;
  for (auto&& [key, value] : *node->as_table()) {
    const std::string name(key.str());
    const Place at{origin, "let." + name, "", value};
    if (!base::Formula::is_name(name))
      throw BadInput(fmt::format("{}: {}: expected a name of letters, digits, _ and dots",
                                 at.where(), at.key));
    definitions.push_back({name, read_expression(at), fmt::format("{}: {}", at.where(), at.key)});
  }
  return definitions;
}

}  // namespace laboratory
