// Reads an entry of a model file: value, unit, provenance, source, range and the formula `holds`.
#include "simulator/machine/model_entry.hpp"

#include <algorithm>

#include "base/errors.hpp"
#include "base/formula.hpp"
#include "base/text.hpp"

namespace machine {

namespace {

Provenance parse_provenance(const std::string& text, const std::string& where) {
  for (auto p :
       {Provenance::datasheet, Provenance::thesis, Provenance::calibrated, Provenance::assumed})
    if (text == to_string(p)) return p;
  base::refuse(where, "provenance: found \"{}\", expected datasheet, thesis, calibrated or assumed",
               text);
}

// Reads an entry's value: a number, or a formula in quotes.
EntryValue read_value(const Entry& entry, const toml::node* node) {
  if (const auto number = node ? node->value<double>() : std::nullopt) return *number;
  if (const auto text = node ? node->value_exact<std::string>() : std::nullopt) return *text;
  base::refuse(entry.where,
               "\"value\": expected a number, or in quotes a formula over other entries");
}

// Reads a bound that is a fraction of the entry's value, such as "80 %".
std::optional<double> read_share(const toml::node& node) {
  auto text = node.value_exact<std::string>().value_or("");
  if (!text.ends_with('%')) return {};
  text.pop_back();
  while (text.ends_with(' ')) text.pop_back();
  const auto number = base::parse_number<double>(text);
  return number ? std::optional(*number / 100) : std::nullopt;
}

// Reads the keys low, high and why. Either all or none of them must be present.
std::optional<Range> read_range(const Entry& entry, const toml::table& table) {
  const auto *low = table.get("low"), *high = table.get("high"), *why = table.get("why");
  if (!low && !high && !why) return {};
  base::require(low && high && why && why->value_exact<std::string>(), entry.where,
                "expected low, high and why together, with a text in quotes as why");
  const auto low_share = read_share(*low), high_share = read_share(*high);
  Range range{0, 0, low_share && high_share, *why->value_exact<std::string>()};
  const auto low_number = range.is_share ? low_share : low->value<double>();
  const auto high_number = range.is_share ? high_share : high->value<double>();
  base::require(
      low_number && high_number, entry.where,
      "low and high: expected two numbers, or two percentages of the value such as \"80 %\"");
  range.low = *low_number;
  range.high = *high_number;
  base::require(range.low < range.high && range.high <= LARGEST_ENTRY && range.low >= 0,
                entry.where,
                "low and high: found {} and {}, expected numbers from 0 to {}, with low below high",
                range.low, range.high, LARGEST_ENTRY);
  base::require(range.is_share || entry.formula.empty(), entry.where,
                "low and high: found numbers, expected percentages such as \"80 %\", because the "
                "value is a formula");
  base::require(!range.is_share || range.low > 0, entry.where,
                "low: found 0 %, expected a percentage above 0");
  return range;
}

}  // namespace

void set_value(Entry& entry, const EntryValue& value) {
  if (const auto* number = std::get_if<double>(&value))
    entry.value = *number;
  else
    base::Formula(entry.formula = std::get<std::string>(value), entry.where);
}

Entry read_entry(const std::string& key, const toml::node& node, const std::string& where) {
  const auto* table = node.as_table();
  base::require(table, where,
                "expected {{ value = ..., unit = ..., provenance = ..., source = ... }}");
  auto text = [&](const char* part) {
    auto value = (*table)[part].value<std::string>();
    base::require(value.has_value(), where, "\"{}\": expected a text in quotes", part);
    return *value;
  };
  constexpr std::string_view PARTS[] = {"value", "unit", "provenance", "source",
                                        "low",   "high", "why",        "holds"};
  for (auto&& [part, ignored] : *table)
    base::require(std::ranges::find(PARTS, part.str()) != std::end(PARTS), where,
                  "unknown part \"{}\"", part.str());
  Entry entry{
      key, 0, {}, text("unit"), parse_provenance(text("provenance"), where), text("source"), where};
  set_value(entry, read_value(entry, table->get("value")));
  entry.range = read_range(entry, *table);
  if (table->contains("holds")) {
    base::require(entry.provenance == Provenance::calibrated, where,
                  "holds: found it in an entry with provenance \"{}\", expected calibrated",
                  to_string(entry.provenance));
    base::Formula(entry.holds = text("holds"), where + ": holds");
  }
  return entry;
}

}  // namespace machine
