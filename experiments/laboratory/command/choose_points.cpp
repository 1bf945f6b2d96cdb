// tlab run --list and --point: the points of a sweep one by one, for machines that share a folder.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "base/errors.hpp"
#include "experiments/laboratory/command/simulate.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/results_folder.hpp"
#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/points/point_key.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/points.hpp"

namespace laboratory {

namespace {

using base::BadInput;

[[noreturn]] void refuse(const std::string& found, std::size_t points) {
  throw BadInput(
      fmt::format("--point {}: expected the number of a point, or two as in 0-9, from 0 to {}",
                  found, points - 1));
}

// "3" or "3-5".
std::pair<std::size_t, std::size_t> read_range(const std::string& text, std::size_t points) {
  std::size_t first = 0, last = 0;
  const char* const end = text.data() + text.size();
  auto [stop, error] = std::from_chars(text.data(), end, first);
  last = first;
  if (error == std::errc() && stop != end && *stop == '-') {
    const auto second = std::from_chars(stop + 1, end, last);
    stop = second.ptr;
    error = second.ec;
  }
  if (error != std::errc() || stop != end || first > last || last >= points) refuse(text, points);
  return {first, last};
}

std::vector<std::size_t> read_numbers(const std::vector<std::string>& texts, std::size_t points) {
  std::vector<std::size_t> numbers;
  for (const auto& text : texts) {
    const auto [first, last] = read_range(text, points);
    for (std::size_t i = first; i <= last; ++i) numbers.push_back(i);
  }
  std::ranges::sort(numbers);
  numbers.erase(std::ranges::unique(numbers).begin(), numbers.end());
  return numbers;
}

// A result that depends on the host and the moment cannot be collected later.
void check_counted(const ExperimentFile& file, const std::vector<std::size_t>& numbers) {
  for (const auto i : numbers)
    if (file.points[i].experiment.is_timed)
      throw BadInput(fmt::format("{}: --point {}: found cost = \"timed\", expected \"counted\"",
                                 file.path, i));
}

// The chosen ones with their results, where they have any.
void judge(const PointsPlan& plan, const std::vector<std::size_t>& numbers,
           const Results& results) {
  ExperimentFile chosen = plan.file;
  chosen.points.clear();
  Results found;
  std::size_t done = 0;
  for (const auto i : numbers) {
    chosen.points.push_back(plan.file.points[i]);
    found.push_back(results[i]);
    if (results[i].is_there() && !results[i].is_failed() && results[i].ended != "interrupt") ++done;
  }
  const auto where = fmt::format("{} of {} points are in {}", done, numbers.size(),
                                 (plan.results / records_folder()).string());
  if (was_interrupted()) throw CutShort("interrupted; " + where);
  throw_failures(chosen, found, where);
  fmt::print("{}\n", where);
}

}  // namespace

void list_points(const RunOptions& options) {
  const ExperimentFile file = load_experiment(options.file, options.overrides);
  const PointsPlan plan(options, file);
  const Results results = find_points(plan, all_points(file));
  for (std::size_t i = 0; i < results.size(); ++i)
    fmt::print("{}\t{}\t{}\t{}\n", i, plan.keys[i], name_of(file.points[i]),
               results[i].is_there() ? "there" : "missing");
}

void run_chosen_points(const RunOptions& options) {
  const ExperimentFile file = load_experiment(options.file, options.overrides);
  const auto numbers = read_numbers(options.points, file.points.size());
  check_counted(file, numbers);
  check_points(options, file, numbers.size());
  const auto folder = results_folder(options);
  check_results_folder(folder);
  check_same_experiment(folder, file);
  const CheckPlan checks = plan_checks(file);
  const StoreGuard guard(folder);
  const PointsPlan plan(options, file, inspect_names(checks, file));
  Results results = find_points(plan, numbers);
  std::vector<std::size_t> missing;
  for (const auto i : numbers)
    if (!results[i].is_there()) missing.push_back(i);
  run_points(plan, missing, results);
  if (missing.size() < numbers.size()) save_origin(folder, plan.origin);
  judge(plan, numbers, results);
}

}  // namespace laboratory
