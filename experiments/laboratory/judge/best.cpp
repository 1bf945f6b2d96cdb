#include "experiments/laboratory/judge/best.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "experiments/laboratory/table/samples.hpp"
#include "experiments/laboratory/table/statistics.hpp"

namespace laboratory {
namespace {

constexpr double TIE = 0.0005;  // results whose relative difference is smaller count as equal

using Axes = std::vector<std::size_t>;

// The result of a point. If several seeds were simulated, it is the mean over the rows (samples)
// that differ only in the seed.
struct Measured {
  std::size_t row = 0;  // row of the first sample in the results table
  double value = 0;
  RowSamples samples = {};
};

// The points that share a combination of values of some axes.
struct Group {
  std::vector<Value> at;
  std::vector<Measured> points;
};

// Finds the axes with several values. Leaves out seeds, axes in `without`, and axes whose value
// follows from those of other axes.
Axes other_axes(const Table& table, const RowList& rows, const Axes& without) {
  Axes axes;
  for (std::size_t axis = 0; axis < table.axes; ++axis)
    if (std::ranges::find(without, axis) == without.end() && !is_seed(table.columns[axis]) &&
        distinct(table, rows, axis).size() > 1 && !is_determined(table, rows, axis, without) &&
        !is_determined(table, rows, axis, axes))
      axes.push_back(axis);
  return axes;
}

std::vector<Value> values_at(const Table& table, std::size_t row, const Axes& axes) {
  std::vector<Value> values;
  for (const auto axis : axes) values.push_back(table.rows[row][axis]);
  return values;
}

std::vector<Group> group_by(const Table& table, const std::vector<Measured>& points,
                            const Axes& axes) {
  std::vector<Group> groups;
  for (const auto& point : points) {
    auto at = values_at(table, point.row, axes);
    auto group = std::ranges::find(groups, at, &Group::at);
    if (group == groups.end()) group = groups.insert(groups.end(), Group{at, {}});
    group->points.push_back(point);
  }
  return groups;
}

// The relative advantage of `better`. For example, 2 s are better than 3 s by 0.5 if the least is
// best.
double share_gained(bool least, double better, double worse) {
  return least ? worse / better - 1 : better / worse - 1;
}

// Averages each group of points that differ only in the seed. The result has one point for each
// group.
std::vector<Measured> average(const Table& table, const std::vector<Measured>& points) {
  if (find_seeds(table).empty()) return points;
  const auto group_of = number_samples(table);
  std::vector<Measured> means;
  std::map<std::size_t, std::size_t> index_of;
  for (const auto& point : points) {
    const auto [at, is_new] = index_of.emplace(group_of[point.row], means.size());
    if (is_new) means.push_back(point);
    auto& samples = means[at->second].samples;
    samples.rows.push_back(point.row);
    samples.values.push_back(point.value);
  }
  for (auto& mean : means) mean.value = find_mean(mean.samples.values);
  return means;
}

// True if two means may differ by chance: the 95 % confidence interval of the difference contains
// 0.
bool may_be_chance(const Table& table, const Measured& a, const Measured& b) {
  if (std::min(a.samples.rows.size(), b.samples.rows.size()) < 2) return false;
  const auto difference = compare_samples(table, a.samples, b.samples);
  return difference.half_width && difference.contains(0);
}

std::vector<std::string> names_of(const Table& table, const Axes& axes) {
  std::vector<std::string> names;
  for (const auto axis : axes) names.push_back(table.columns[axis]);
  return names;
}

std::string value_column(const BestSpec& spec) {
  return base::Formula::is_name(spec.of) ? spec.of : "value";
}

double in_percent(double share) { return std::round(share * 1000) / 10; }

// Adds a sentence such as "least time: mesh in 3, line in 1 of 4 cases, by at most 12.5 %."
void tell_winners(BestAnswer& answer, const std::map<std::string, std::size_t>& wins) {
  std::vector<std::pair<std::string, std::size_t>> sorted(wins.begin(), wins.end());
  std::ranges::stable_sort(sorted, std::greater(), &std::pair<std::string, std::size_t>::second);
  std::vector<std::string> parts;
  for (const auto& [name, count] : sorted) parts.push_back(fmt::format("{} in {}", name, count));
  double most = 0;
  for (const auto& row : answer.best.rows) most = std::max(most, as_number(row.back()).value_or(0));
  answer.findings.push_back(fmt::format("{}: {} of {} cases, by at most {:.1f} %.", answer.name,
                                        join_texts(parts, ", "), answer.best.rows.size(), most));
}

void compare(BestAnswer& answer, const BestSpec& spec, const Table& table,
             const std::vector<Measured>& points, const Axes& over, const Axes& for_each) {
  answer.best.columns = names_of(table, for_each);
  answer.best.axes = for_each.size();
  for (const auto& column : {std::string("best"), value_column(spec), std::string("runner_up"),
                             "runner_up_" + value_column(spec), std::string("better by %")})
    answer.best.columns.push_back(column);
  std::map<std::string, std::size_t> wins;
  for (auto& group : group_by(table, points, for_each)) {
    std::ranges::stable_sort(group.points, [&](const Measured& a, const Measured& b) {
      return spec.least ? a.value < b.value : a.value > b.value;
    });
    const auto& first = group.points[0];
    std::string name = name_values(table, first.row, over);
    std::size_t next = 1;  // index of the runner-up in the sorted points
    const auto gained = [&] {
      return share_gained(spec.least, first.value, group.points[next].value);
    };
    // names already seen; points that differ only in axes outside `over` have the same name
    std::set<std::string> named{name};
    for (; next < group.points.size(); ++next) {
      const auto other = name_values(table, group.points[next].row, over);
      if (named.contains(other)) continue;
      if (gained() >= TIE && !may_be_chance(table, first, group.points[next])) break;
      named.insert(other);
      name += " or " + other;
    }
    ++wins[name];
    auto& row = answer.best.rows.emplace_back(group.at);
    row.insert(row.end(), {name, first.value});
    if (next < group.points.size())
      row.insert(row.end(), {name_values(table, group.points[next].row, over),
                             group.points[next].value, in_percent(gained())});
    row.resize(answer.best.columns.size());
  }
  tell_winners(answer, wins);
}

// The relative gain of a step from one value of an axis to the next, converted to the gain of one
// doubling of the axis.
double gain_per_doubling(const BestSpec& spec, const std::pair<double, double>& from,
                         const std::pair<double, double>& to) {
  const double doublings = std::log2(to.first / from.first);
  return std::pow(1 + share_gained(spec.least, to.second, from.second), 1 / doublings) - 1;
}

// sentences, each with the names of the groups of points for which it is true
using GroupedSentences = std::vector<std::pair<std::string, std::vector<std::string>>>;

void add_sentence(GroupedSentences& grouped, const std::string& sentence,
                  const std::string& group) {
  auto same = std::ranges::find(grouped, sentence, &GroupedSentences::value_type::first);
  if (same == grouped.end()) same = grouped.insert(grouped.end(), {sentence, {}});
  same->second.push_back(group);
}

// Adds a sentence with its groups, such as "mesh; torus: doubling workers pays up to 8."
void tell_groups(BestAnswer& answer, const GroupedSentences& grouped) {
  for (const auto& [sentence, groups] : grouped) {
    const auto names = join_texts(groups, "; ");
    answer.findings.push_back(names.empty() ? sentence : fmt::format("{}: {}", names, sentence));
  }
}

void find_end(BestAnswer& answer, const BestSpec& spec, const Table& table,
              const std::vector<Measured>& points, std::size_t axis, const Axes& groups) {
  answer.pays.columns = names_of(table, groups);
  answer.pays.axes = groups.size();
  answer.pays.columns.push_back("pays_up_to_" + spec.pays);
  answer.pays.columns.emplace_back("next doubling gains %");
  GroupedSentences grouped;
  for (const auto& group : group_by(table, points, groups)) {
    std::map<double, double> curve;
    for (const auto& p : group.points)
      if (const auto x = as_number(table.rows[p.row][axis]); x && *x > 0) curve[*x] = p.value;
    if (curve.empty()) continue;
    auto& row = answer.pays.rows.emplace_back(group.at);
    auto end = curve.begin();
    Value next;
    for (auto step = std::next(end); step != curve.end(); end = step++) {
      const double gain = gain_per_doubling(spec, *end, *step);
      if (gain >= spec.gain) continue;
      next = in_percent(gain);
      break;
    }
    row.insert(row.end(), {to_cell(end->first), next});
    add_sentence(
        grouped,
        fmt::format(
            "doubling {} pays up to {:g}{}.", make_label(spec.pays), end->first,
            std::holds_alternative<std::monostate>(next) ? ", the largest value tried" : ""),
        group.at.empty() ? "" : name_values(table, group.points[0].row, groups));
  }
  tell_groups(answer, grouped);
}

BestAnswer answer_question(const CheckPlan::Question& question, const Rows& rows) {
  const auto& [spec, of, where] = question;
  const Table& table = rows.table();
  BestAnswer answer;
  answer.name = spec.name;
  const auto chosen = choose_rows(rows, where);
  std::vector<Measured> points;
  RowList left_out;
  for (const auto row : chosen) {
    const auto value = rows.eval(of, row);
    if (!value) left_out.push_back(row);
    if (value && std::isfinite(*value)) points.push_back({row, *value});
  }
  points = average(table, points);
  if (const auto note = note_left_out(table, left_out)) answer.notes.push_back(*note);
  const Axes over = find_all(table, spec.over);
  const Axes for_each =
      spec.for_each.empty() ? other_axes(table, chosen, over) : find_all(table, spec.for_each);
  compare(answer, spec, table, points, over, for_each);
  if (spec.pays.empty()) return answer;
  const auto axis = *table.find(spec.pays);
  Axes groups = for_each;
  std::erase_if(groups,
                [&](auto a) { return a == axis || is_determined(table, chosen, a, {axis}); });
  groups.insert(groups.end(), over.begin(), over.end());
  find_end(answer, spec, table, points, axis, groups);
  return answer;
}

// Joins one table of each answer: its member `part`. Each row of the result begins with the
// question's name and the row's axis values as text.
Table make_csv(const std::vector<BestAnswer>& answers, Table BestAnswer::*part,
               std::vector<std::string> columns) {
  columns.insert(columns.begin(), {"question", "at"});
  Table csv{.columns = columns, .axes = 2, .rows = {}};
  for (const auto& answer : answers) {
    const Table& table = answer.*part;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const auto& row = table.rows[i];
      auto& added = csv.rows.emplace_back(std::vector<Value>{answer.name, name_axes(table, i)});
      added.insert(added.end(), row.begin() + static_cast<std::ptrdiff_t>(table.axes), row.end());
    }
  }
  return csv;
}

}  // namespace

std::vector<BestAnswer> find_best(const CheckPlan& plan, const Rows& rows) {
  std::vector<BestAnswer> answers;
  for (const auto& question : plan.questions) answers.push_back(answer_question(question, rows));
  return answers;
}

Table make_best_csv(const std::vector<BestAnswer>& answers) {
  return make_csv(answers, &BestAnswer::best,
                  {"best", "value", "runner_up", "runner_up_value", "better_by_percent"});
}

Table make_pays_csv(const std::vector<BestAnswer>& answers) {
  return make_csv(answers, &BestAnswer::pays, {"pays_up_to", "next_doubling_gains_percent"});
}

}  // namespace laboratory
