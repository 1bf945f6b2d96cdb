#include <cmath>
#include <set>
#include "base/errors.hpp"

#include "base/formula.hpp"
#include "base/toml.hpp"
#include "experiments/laboratory/file/expression.hpp"
#include "experiments/laboratory/table/table.hpp"
#include "simulator/machine/model.hpp"
#include "tests/fuzz/kinds.hpp"

namespace fuzz {
namespace {

using laboratory::Table;

bool is_same_cell(const laboratory::Value& a, const laboratory::Value& b) {
  const auto *x = std::get_if<double>(&a), *y = std::get_if<double>(&b);
  if (x && y && std::isnan(*x)) return std::isnan(*y);
  return a == b;
}

void read_csv(const std::string& text) {
  const Table table = laboratory::parse_csv(text, "fuzz.csv");
  const std::string written = to_csv(table);
  const Table again =
      read_again("CSV", [&] { return laboratory::parse_csv(written, "again.csv"); });
  expect_same("columns", again.columns, table.columns);
  expect_same("the number of rows", again.rows.size(), table.rows.size());
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    expect_same("the number of cells", again.rows[r].size(), table.rows[r].size());
    for (std::size_t c = 0; c < table.rows[r].size(); ++c)
      expect(is_same_cell(again.rows[r][c], table.rows[r][c]), "a cell is the same again");
  }
  expect_same("CSV", to_csv(again), written);
  to_text(table);
}

double eval(const base::Formula& formula) {
  std::vector<double> values;
  for (std::size_t i = 0; i < formula.variables().size(); ++i)
    values.push_back(1.5 + static_cast<double>(i));
  return formula.eval(values);
}

void read_formula(const std::string& text) {
  const base::Formula formula(text, "fuzz"), again(text, "again");
  const auto& names = formula.variables();
  expect_same("the number of names", std::set<std::string>(names.begin(), names.end()).size(),
              names.size());
  for (const auto& name : names) expect(base::Formula::is_name(name), "a variable is a name");
  const double first = eval(formula), second = eval(again);
  expect(first == second || (std::isnan(first) && std::isnan(second)), "the value is the same");
}

void read_expression(const std::string& text) {
  const laboratory::Expression expression(text, "fuzz");
  expression.names();
  expression.eval(std::vector<double>(expression.variables().size(), 1.5));
}

void read_toml(const std::string& text) {
  const std::string written = base::to_toml(base::parse_toml(text, "fuzz.toml"));
  const auto again = read_again("TOML", [&] { return base::parse_toml(written, "again.toml"); });
  expect_same("TOML", base::to_toml(again), written);
}

void read_model(const std::string& text) {
  const auto model = machine::parse_model(text, "fuzz.toml");
  describe(model);
  for (const auto& entry : model.entries)
    expect(std::isfinite(entry.value), "an entry is a finite number");
}

}  // namespace

std::vector<Reader> text_readers() {
  return {
      {"csv", ".csv", {"experiments/reference"}, read_csv},
      {"formula", ".txt", {}, read_formula},
      {"expression", ".txt", {}, read_expression},
      {"toml", ".toml", {"experiments/formulas"}, read_toml},
      {"model", ".toml", {"simulator/machine/models"}, read_model},
  };
}

}  // namespace fuzz
