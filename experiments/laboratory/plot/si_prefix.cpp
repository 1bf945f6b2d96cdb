#include "experiments/laboratory/plot/si_prefix.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

namespace laboratory {
namespace {

// A unit with a prefix, and the prefix as a power of ten. A family has one unit under all prefixes.
struct PrefixedUnit {
  const char* name;
  int power;
};
using UnitFamily = std::vector<PrefixedUnit>;

const UnitFamily* find_family(const std::string& unit) {
  static const std::vector<UnitFamily> FAMILIES = {
      {{"ns", -9}, {"µs", -6}, {"ms", -3}, {"s", 0}},
      {{"bytes", 0}, {"kB", 3}, {"MB", 6}, {"GB", 9}},
      {{"bits", 0}, {"kbit", 3}, {"Mbit", 6}, {"Gbit", 9}},
      {{"bytes/s", 0}, {"kB/s", 3}, {"MB/s", 6}, {"GB/s", 9}},
      {{"bit/s", 0}, {"kbit/s", 3}, {"Mbit/s", 6}, {"Gbit/s", 9}},
      {{"Hz", 0}, {"kHz", 3}, {"MHz", 6}, {"GHz", 9}}};
  for (const auto& family : FAMILIES)
    if (std::ranges::find(family, unit, &PrefixedUnit::name) != family.end()) return &family;
  return nullptr;
}

// The unit at the end of a label such as "time [s]"; "" if there is none.
std::string find_unit_of_label(const std::string& label) {
  const auto open = label.rfind(" [");
  if (open == std::string::npos || !label.ends_with(']')) return "";
  const auto unit = label.substr(open + 2, label.size() - open - 3);
  return unit == "us" ? "µs" : unit;
}

// True if the positive numbers span a factor of more than 1000, so that no prefix suits all of
// them.
bool is_wide(const std::vector<Series>& all, std::vector<double> Series::*values) {
  constexpr double WIDE = 1000;
  double low = INFINITY, high = 0;
  for (const auto& series : all)
    for (const double value : series.*values)
      if (std::isfinite(value) && value > 0) {
        low = std::min(low, value);
        high = std::max(high, value);
      }
  return high > WIDE * low;
}

// Gives the unit in the label the prefix that suits the largest number. Returns the factor for the
// numbers; none if the label already has this prefix, or has an unknown unit.
std::optional<double> change_unit(std::string& label, double largest) {
  const auto unit = find_unit_of_label(label);
  const auto* family = find_family(unit);
  if (!family || !(largest > 0) || !std::isfinite(largest)) return std::nullopt;
  const auto now = std::ranges::find(*family, unit, &PrefixedUnit::name);
  auto best = family->begin();
  for (auto other = family->begin(); other != family->end(); ++other)
    if (largest * std::pow(10, now->power - other->power) >= 1) best = other;
  if (best == now) return std::nullopt;
  label = fmt::format("{} [{}]", without_unit(label), best->name);
  return std::pow(10, now->power - best->power);
}

void scale(std::vector<double>& values, double factor) {
  // divides by a power of ten, since multiplication by its inexact inverse would round twice
  for (double& value : values) value = factor < 1 ? value / std::round(1 / factor) : value * factor;
}

double find_largest_number(const std::vector<Series>& all, std::vector<double> Series::*values) {
  double largest = 0;
  for (const auto& series : all)
    for (const double value : series.*values)
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  return largest;
}

bool are_powers_of_two(const std::vector<Series>& all) {
  return std::ranges::all_of(all, [](const Series& series) {
    return series.kind == SeriesKind::law || std::ranges::all_of(series.x, [](double x) {
             return x > 0 && std::exp2(std::round(std::log2(x))) == x;
           });
  });
}

void scale_x(Plot& plot) {
  if (are_powers_of_two(plot.series) || (plot.log_x && is_wide(plot.series, &Series::x))) return;
  const auto factor = change_unit(plot.x_label, find_largest_number(plot.series, &Series::x));
  if (!factor) return;
  for (auto* all : {&plot.series, &plot.differences})
    for (auto& series : *all) scale(series.x, *factor);
}

void scale_y(Plot& plot) {
  if (plot.log_y && is_wide(plot.series, &Series::y)) return;
  const double largest = std::max({find_largest_number(plot.series, &Series::y),
                                   find_largest_number(plot.series, &Series::high)});
  const auto factor = change_unit(plot.y_label, largest);
  if (!factor) return;
  for (auto& series : plot.series)
    for (auto* values : {&series.y, &series.low, &series.high}) scale(*values, *factor);
  for (auto* limit : {&plot.y_min, &plot.y_max, &plot.level})
    if (*limit) **limit *= *factor;
}

}  // namespace

void choose_prefixes(Plot& plot) {
  const bool has_law =
      std::ranges::find(plot.series, SeriesKind::law, &Series::kind) != plot.series.end();
  if (plot.ideal_line || has_law) return;
  scale_x(plot);
  scale_y(plot);
}

}  // namespace laboratory
