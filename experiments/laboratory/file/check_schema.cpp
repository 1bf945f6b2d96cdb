// [[check]] and [let], as they stand in the file.
#include <cmath>

#include "base/errors.hpp"
#include "base/formula.hpp"
#include "experiments/laboratory/file/binding.hpp"
#include "experiments/laboratory/file/schema.hpp"

namespace laboratory {

namespace {

using base::BadInput;

constexpr double LARGEST = 1e300;

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
       [](C& c, const P& at) { c.reference = read_source(at); }},
      {"keys", "columns of both that say which row is which point",
       [](C& c, const P& at) { c.keys = read_texts(at); }},
      {"column", "the reference's column, if it is not called as `of`",
       [](C& c, const P& at) { c.column = read_text(at); }},
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

void check_complete(const Check& c) {
  auto expect = [&](bool holds, const char* what) {
    if (!holds) throw BadInput(fmt::format("{}: {}", c.place, what));
  };
  expect(!c.name.empty(), "\"name\" is missing");
  expect(!c.of.empty(), "\"of\" is missing, expected a column of the results");
  expect(c.formula.empty() != c.reference.empty(), "expected either a formula or a reference");
  expect(
      c.reference.empty() == c.keys.empty(),
      "expected keys, columns of the results and the reference, with a reference and only there");
  expect(!c.reference.empty() || c.column.empty(), "expected no column without a reference");
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
  check_complete(check);
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
    const bool is_number = value.is_number() && std::isfinite(*value.value<double>());
    definitions.push_back({name, is_number ? to_toml(value) : read_text(at),
                           fmt::format("{}: {}", at.where(), at.key)});
  }
  return definitions;
}

}  // namespace laboratory
