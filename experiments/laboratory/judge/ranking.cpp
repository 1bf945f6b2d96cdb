#include "experiments/laboratory/judge/ranking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/points/results.hpp"

namespace laboratory {
namespace {

constexpr const char* RANKINGS = "rankings.csv";
enum Column : std::size_t { question, at, best, machines, of, elsewhere, COLUMNS };

// Splits a cell with several equally good values, such as "mesh or torus".
std::vector<std::string> split_ties(const std::string& names) {
  constexpr std::string_view OR = " or ";
  std::vector<std::string> all;
  std::size_t from = 0;
  for (auto to = names.find(OR); to != names.npos; to = names.find(OR, from)) {
    all.push_back(names.substr(from, to - from));
    from = to + OR.size();
  }
  all.push_back(names.substr(from));
  return all;
}

// True if all values in the cell `names` also occur in the cell `there`.
bool are_best(const std::string& names, const std::string& there) {
  const auto those = split_ties(there);
  return std::ranges::all_of(split_ties(names), [&](const auto& name) {
    return std::ranges::find(those, name) != those.end();
  });
}

// Makes an experiment with the points of one randomly drawn machine. `machine` is the number of
// this machine, from 0.
ExperimentFile make_machine(const ExperimentFile& file, const ExperimentFile& all,
                            std::size_t machine) {
  ExperimentFile own = file;
  for (std::size_t i = 0; i < own.points.size(); ++i)
    own.points[i].experiment = all.points[(machine + 1) * own.points.size() + i].experiment;
  return own;
}

// the best value, by question and combination of axis values
using Cases = std::map<std::pair<std::string, std::string>, std::string>;

Table answer(const CheckPlan& plan, const ExperimentFile& file, const Results& results) {
  const Table table = make_table(plan, file, results);
  return make_best_csv(find_best(plan, make_rows(plan, file, table)));
}

Cases find_cases(const Table& answers) {
  Cases cases;
  for (const auto& row : answers.rows)
    cases[{to_string(row[question]), to_string(row[at])}] = to_string(row[best]);
  return cases;
}

// Formats the best values on the machines that disagree with the nominal model, such as "mesh on 5,
// line on 1, others on 3". Names at most three values, the most frequent first.
std::string describe_others(const std::map<std::string, std::size_t>& others) {
  std::vector<std::pair<std::string, std::size_t>> sorted(others.begin(), others.end());
  std::ranges::stable_sort(sorted, std::greater(), &std::pair<std::string, std::size_t>::second);
  constexpr std::size_t MOST = 3;
  std::vector<std::string> parts;
  std::size_t rest = 0;
  for (const auto& [name, count] : sorted)
    if (parts.size() < MOST)
      parts.push_back(fmt::format("{} on {}", name, count));
    else
      rest += count;
  if (rest > 0) parts.push_back(fmt::format("others on {}", rest));
  return join_texts(parts, ", ");
}

}  // namespace

Table find_rankings(const CheckPlan& plan, const ExperimentFile& file, const ExperimentFile& all,
                    const Results& results) {
  Table rankings{
      .columns = {"question", "at", "best", "machines", "of", "others"}, .axes = 2, .rows = {}};
  const auto points = static_cast<std::ptrdiff_t>(file.points.size());
  const auto results_of = [&](std::ptrdiff_t nth) {
    return Results(results.begin() + nth * points, results.begin() + (nth + 1) * points);
  };
  const auto is_whole = [](const Results& own) {
    return std::ranges::all_of(own, &PointResult::is_complete);
  };
  if (plan.questions.empty() || !is_whole(results_of(0))) return rankings;
  std::vector<Cases> drawn;
  for (std::size_t machine = 0; machine < static_cast<std::size_t>(file.uncertain.machines);
       ++machine)
    if (const auto own = results_of(static_cast<std::ptrdiff_t>(machine) + 1); is_whole(own))
      drawn.push_back(find_cases(answer(plan, make_machine(file, all, machine), own)));
  for (const auto& row : answer(plan, file, results_of(0)).rows) {
    const std::pair key(to_string(row[question]), to_string(row[at]));
    const auto name = to_string(row[best]);
    std::int64_t agree = 0, count = 0;
    std::map<std::string, std::size_t> others;
    for (const auto& cases : drawn) {
      const auto found = cases.find(key);
      if (found == cases.end()) continue;
      ++count;
      if (are_best(name, found->second))
        ++agree;
      else
        ++others[found->second];
    }
    rankings.rows.push_back({key.first, key.second, name, agree, count, describe_others(others)});
  }
  return rankings;
}

void save_rankings(const std::filesystem::path& folder, const Table& rankings) {
  if (!rankings.rows.empty()) base::save_whole(folder / RANKINGS, to_csv(guard_formulas(rankings)));
}

std::optional<Table> load_rankings(const std::filesystem::path& folder) {
  const auto file = folder / RANKINGS;
  if (!std::filesystem::exists(file)) return {};
  auto table = parse_csv(base::read_own_text(file), file.string());
  base::require(table.columns.size() == COLUMNS && table.columns[machines] == "machines",
                file.string(), "damaged: found other columns");
  return table;
}

void add_rankings(std::vector<BestAnswer>& answers, const Table& rankings) {
  for (auto& [name, table, pays, notes, findings] : answers) {
    table.columns.emplace_back("best on machines");
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
      const auto its = name_axes(table, i);
      Value cell;
      for (const auto& ranked : rankings.rows)
        if (to_string(ranked[question]) == name && to_string(ranked[at]) == its)
          cell = fmt::format("{} of {}", to_string(ranked[machines]), to_string(ranked[of]));
      table.rows[i].push_back(std::move(cell));
    }
  }
}

std::vector<std::string> tell_rankings(const Table& rankings) {
  std::vector<std::string> sentences, told;
  for (const auto& row : rankings.rows) {
    const auto name = to_string(row[question]);
    if (std::ranges::find(told, name) != told.end()) continue;
    told.push_back(name);
    std::vector<const std::vector<Value>*> cases;
    for (const auto& other : rankings.rows)
      if (to_string(other[question]) == name) cases.push_back(&other);
    const auto& least = **std::ranges::min_element(
        cases, {}, [](const auto* its) { return as_number((*its)[machines]).value_or(0); });
    const auto all = std::ranges::count_if(cases, [](const auto* its) {
      return to_string((*its)[machines]) == to_string((*its)[of]);
    });
    const auto others = to_string(least[elsewhere]);
    std::string text = fmt::format("{}: ", name);
    if (cases.size() > 1)
      text += fmt::format("the same is best on all {} machines in {} of {} cases; least sure{}: ",
                          to_string(least[of]), all, cases.size(),
                          to_string(least[at]).empty() ? "" : " at " + to_string(least[at]));
    text += fmt::format("{} is best on {} of {} machines{}.", to_string(least[best]),
                        to_string(least[machines]), to_string(least[of]),
                        others.empty() ? "" : ", " + others);
    sentences.push_back(std::move(text));
  }
  return sentences;
}

}  // namespace laboratory
