#include "experiments/laboratory/report/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "experiments/laboratory/table/power_law.hpp"

namespace laboratory {
namespace {

using Texts = std::vector<std::string>;
using Curves = std::vector<const Series*>;

Curves curves_of(const Plot& plot) {
  Curves curves;
  for (const auto& s : plot.series)
    if (s.kind == SeriesKind::curve && !s.is_stepped && !s.x.empty()) curves.push_back(&s);
  return curves;
}

// Formats a value of x with its unit, or with its name: "7 workers", "1000 s", "width 32".
std::string name_x(const Plot& plot, double x) {
  const auto name = without_unit(plot.x_label);
  if (name.size() < plot.x_label.size())
    return fmt::format("{:g} {}", x,
                       plot.x_label.substr(name.size() + 2, plot.x_label.size() - name.size() - 3));
  return name.ends_with('s') ? fmt::format("{:g} {}", x, name) : fmt::format("{} {:g}", name, x);
}

// Joins texts for a sentence: "200, 800 and 3200".
std::string join_and(const Texts& texts) {
  if (texts.size() < 2) return texts.empty() ? "" : texts[0];
  return join_texts({texts.begin(), texts.end() - 1}, ", ") + " and " + texts.back();
}

// Lists some of a plot's curves: " for line and ring", or " for all 8 curves". Returns "" if the
// plot has only one curve.
std::string name_curves(const Curves& some, std::size_t all) {
  constexpr std::size_t MOST_NAMES = 8;
  if (all < 2) return "";
  if (some.size() == all && all > 2) return fmt::format(" for all {} curves", all);
  if (some.size() > MOST_NAMES) return fmt::format(" for {} of {} curves", some.size(), all);
  Texts names;
  for (const auto* s : some) names.push_back(s->name);
  return " for " + join_and(names);
}

// Begins a sentence with a capital letter.
std::string begin(std::string sentence) {
  sentence[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(sentence[0])));
  return sentence;
}

// ---- Bends of curves ----

struct FittedCurve {
  const Series* curve;
  PowerLaw law;
};

// Formats a power law as "workers^0.95", or those of several curves as a range,
// "workers^0.90…0.95".
std::string name_power(const std::string& x, const std::vector<FittedCurve>& all,
                       double PowerLaw::*exponent) {
  const auto [low, high] =
      std::ranges::minmax(all, {}, [&](const FittedCurve& fitted) { return fitted.law.*exponent; });
  // adding 0 turns the rounded exponent -0 into 0
  const auto round = [](double value) {
    return fmt::format("{:.2f}", std::round(100 * value) / 100 + 0.0);
  };
  const auto from = round(low.law.*exponent), to = round(high.law.*exponent);
  return from == to ? fmt::format("{}^{}", x, from) : fmt::format("{}^{}…{}", x, from, to);
}

std::string tell_bends(const Plot& plot) {
  const auto curves = curves_of(plot);
  std::map<std::optional<double>, std::vector<FittedCurve>> groups;
  for (const auto* s : curves)
    if (const auto law = fit_power_law(s->x, s->y)) groups[law->bend].push_back({s, *law});
  if (groups.empty()) return "";
  const auto x = without_unit(plot.x_label);
  Texts bends;
  std::string straight;
  for (const auto& [bend, group] : groups) {
    Curves some;
    for (const auto& fitted : group) some.push_back(fitted.curve);
    const auto names = name_curves(some, curves.size());
    const auto before = name_power(x, group, &PowerLaw::before);
    if (bend)
      bends.push_back(fmt::format("at {}{} ({}, then {})", name_x(plot, *bend), names, before,
                                  name_power(x, group, &PowerLaw::after)));
    else
      straight = fmt::format("has no bend{} (goes as {})", names, before);
  }
  const auto y = without_unit(plot.y_label);
  if (bends.empty()) return fmt::format("{} {}.", y, straight);
  return fmt::format("{} bends {}{}{}.", y, join_texts(bends, ", "),
                     straight.empty() ? "" : "; it ", straight);
}

// ---- Limiting resources ----

// The resource that limits a curve at its last point.
struct Limit {
  const Series* curve;
  const programs::Load* load;  // the busiest resource of the curve's last point
  // x of the first point from which on this resource is always the limit
  double from;
};

// The name under which points limited by this resource are counted. All links have the same name,
// because different links may be the busiest at different points.
std::string part_of(const programs::Load* limit) {
  if (!limit) return "";
  const auto& name = limit->resource;
  if (name.starts_with("link ")) return "a link";
  return name.ends_with(" (routing)") ? "routing" : name;
}

// Finds the resource that limits a curve; no value if the loads of one of its points are unknown.
std::optional<Limit> find_limit_of(const Series& s, const Table& table,
                                   const std::vector<PointLoads>& points) {
  Texts parts;
  const PointLoads* last = nullptr;
  for (const auto row : s.rows) {
    last = &points.at(table.point_of(row));
    if (last->loads.empty()) return std::nullopt;
    parts.push_back(part_of(find_limit(*last)));
  }
  if (!last) return std::nullopt;
  auto from = parts.size() - 1;
  while (from > 0 && parts[from - 1] == parts.back()) --from;
  return Limit{&s, &last->loads[0], s.x[from]};
}

// Describes from which x on the same resource limits several curves: "from 4 workers on for line,
// throughout for ring".
std::string tell_since(const Plot& plot, const std::vector<Limit>& limits, std::size_t all) {
  // key: false if the limit holds throughout, and the x from which on it holds
  std::map<std::pair<bool, double>, Curves> since;
  for (const auto& limit : limits) {
    const bool is_later = limit.from > limit.curve->x.front();
    since[{is_later, is_later ? limit.from : 0}].push_back(limit.curve);
  }
  Texts parts;
  for (const auto& [from, some] : since)
    parts.push_back((from.first ? fmt::format("from {} on", name_x(plot, from.second))
                                : std::string("throughout")) +
                    name_curves(some, all));
  return join_texts(parts, ", ");
}

// Describes the last point of the curve whose resource is the busiest, as an example: "200 objects
// at 7 workers 0.98: its CPU 42 %".
std::string tell_example(const Plot& plot, const std::vector<Limit>& limits,
                         const std::string& part) {
  const auto& limit =
      *std::ranges::max_element(limits, {}, [](const Limit& l) { return l.load->busy; });
  auto load = tell_load(*limit.load);
  if (part == limit.load->resource)
    load.erase(0, part.size());
  else
    load.insert(0, part.empty() ? ", busiest " : ", ");
  return fmt::format("{}at {}{}", limits.size() > 1 ? limit.curve->name + " " : "",
                     name_x(plot, limit.curve->x.back()), load);
}

std::string tell_limits(const Plot& plot, const Table& table,
                        const std::vector<PointLoads>& points) {
  const auto curves = curves_of(plot);
  // limits by resource; the key "" stands for curves without a saturated resource, and comes first
  std::map<std::string, std::vector<Limit>> groups;
  for (const auto* s : curves)
    if (const auto limit = find_limit_of(*s, table, points))
      groups[limit->load->busy < SATURATED ? "" : part_of(limit->load)].push_back(*limit);
  Texts parts;
  for (const auto& [part, limits] : groups) {
    const auto example = tell_example(plot, limits, part);
    if (!part.empty())
      parts.push_back(
          fmt::format("by {} {} ({})", part, tell_since(plot, limits, curves.size()), example));
  }
  std::string sentence = parts.empty() ? "" : "limited " + join_texts(parts, "; ");
  if (const auto none = groups.find(""); none != groups.end()) {
    Curves some;
    for (const auto& limit : none->second) some.push_back(limit.curve);
    sentence +=
        fmt::format("{}nothing is saturated at the end{} ({})", sentence.empty() ? "" : "; ",
                    name_curves(some, curves.size()), tell_example(plot, none->second, ""));
  }
  return sentence.empty() ? "" : sentence + ".";
}

// ---- Largest and smallest curve ----

struct End {
  double y;
  const Series* curve;
  std::size_t point;  // index of the point in the curve
};

// The values of all curves that have a point at this x.
std::vector<End> values_at(const Curves& curves, double x) {
  std::vector<End> values;
  for (const auto* s : curves)
    if (const auto at = std::ranges::find(s->x, x); at != s->x.end())
      values.push_back({s->y[static_cast<std::size_t>(at - s->x.begin())], s,
                        static_cast<std::size_t>(at - s->x.begin())});
  return values;
}

// Formats a value. For a mean over seeds, adds half the width of its confidence interval.
std::string tell_value(const End& end) {
  const Series& s = *end.curve;
  if (!s.has_bars || s.low[end.point] == s.high[end.point]) return fmt::format("{:.3g}", end.y);
  return fmt::format("{:.3g} ± {:.2g}", end.y, (s.high[end.point] - s.low[end.point]) / 2);
}

// Says whether the difference of two means over seeds may be due to chance; "" without several
// seeds.
std::string tell_chance(const Table& table, const End& low, const End& high) {
  if (!low.curve->has_bars || !high.curve->has_bars) return "";
  const auto difference =
      compare_samples(table, low.curve->samples[low.point], high.curve->samples[high.point]);
  if (!difference.half_width) return "";
  return fmt::format("; the difference is {:.3g} ± {:.2g}{}", difference.mean,
                     *difference.half_width, difference.contains(0) ? ", which may be chance" : "");
}

// Compares the curves at one x: the largest that at least half of the curves have.
std::string tell_extremes(const Plot& plot, const Table& table) {
  constexpr double ALIKE = 0.01;
  const auto curves = curves_of(plot);
  std::set<double, std::greater<>> xs;
  for (const auto* s : curves) xs.insert(s->x.begin(), s->x.end());
  const auto x = std::ranges::find_if(xs, [&](double at) {
    const auto there = values_at(curves, at).size();
    return there > 1 && 2 * there >= curves.size();
  });
  if (x == xs.end()) return "";
  const auto values = values_at(curves, *x);
  const auto [low, high] = std::ranges::minmax(values, {}, &End::y);
  const auto y = without_unit(plot.y_label), at = name_x(plot, *x);
  if (high.y - low.y <= ALIKE * std::abs(high.y))
    return fmt::format("at {} the {} curves have the same {} within 1 %: {:.3g}.", at,
                       values.size(), y, high.y);
  return fmt::format("at {} {} is largest for {} ({}) and smallest for {} ({}){}.", at, y,
                     high.curve->name, tell_value(high), low.curve->name, tell_value(low),
                     tell_chance(table, low, high));
}

// The table row of each curve's last point.
RowList ends_of(const Plot& plot) {
  RowList rows;
  for (const auto* s : curves_of(plot))
    if (!s->rows.empty()) rows.push_back(s->rows.back());
  return rows;
}

}  // namespace

std::vector<std::string> tell_plots(const std::vector<Plot>& plots, bool titled, const Table& table,
                                    const std::vector<PointLoads>& points) {
  Texts findings;
  std::set<std::size_t> told;  // rows whose limits a sentence has mentioned
  for (const auto& plot : plots) {
    Texts sentences = {tell_bends(plot), tell_extremes(plot, table)};
    const auto ends = ends_of(plot);
    if (std::ranges::any_of(ends, [&](auto row) { return !told.contains(row); }))
      sentences.insert(sentences.begin() + 1, tell_limits(plot, table, points));
    told.insert(ends.begin(), ends.end());
    std::erase(sentences, "");
    for (auto& sentence : sentences) sentence = begin(sentence);
    const auto all = join_texts(sentences, " ");
    const bool says_y = plot.title == begin(without_unit(plot.y_label));
    if (!titled)
      findings.insert(findings.end(), sentences.begin(), sentences.end());
    else if (!all.empty())
      findings.push_back(says_y ? all : fmt::format("{}: {}", plot.title, all));
  }
  return findings;
}

std::vector<std::string> tell_points(const std::vector<PointLoads>& points) {
  std::map<std::string, int> numbers;  // number of points by limiting resource
  const PointLoads* known = nullptr;
  int all = 0;
  for (const auto& point : points) {
    if (point.loads.empty()) continue;
    ++numbers[part_of(find_limit(point))];
    ++all;
    known = &point;
  }
  if (!known) return {};
  if (all == 1) return {explain(*known)};
  std::vector<std::pair<std::string, int>> parts(numbers.begin(), numbers.end());
  std::ranges::stable_sort(parts, std::ranges::greater{}, &std::pair<std::string, int>::second);
  Texts limited;
  for (const auto& [part, number] : parts)
    if (!part.empty())
      limited.push_back(limited.empty() ? fmt::format("{} of {} points by {}", number, all, part)
                                        : fmt::format("{} by {}", number, part));
  if (limited.empty()) return {fmt::format("Nothing is saturated in any of {} points.", all)};
  return {fmt::format(
      "Limited: {}{}.", join_texts(limited, ", "),
      numbers.contains("") ? fmt::format("; in {} nothing is saturated", numbers.at("")) : "")};
}

}  // namespace laboratory
