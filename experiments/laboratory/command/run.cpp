#include "experiments/laboratory/command/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <ranges>
#include <set>

#include "base/errors.hpp"
#include "base/text.hpp"
#include "experiments/laboratory/film/fault_drawings.hpp"
#include "experiments/laboratory/film/film.hpp"
#include "experiments/laboratory/film/recorded_point.hpp"
#include "experiments/laboratory/host/colour.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/results_folder.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/judge/best.hpp"
#include "experiments/laboratory/judge/ranking.hpp"
#include "experiments/laboratory/points/means.hpp"
#include "experiments/laboratory/points/point_store.hpp"
#include "experiments/laboratory/points/points.hpp"
#include "experiments/laboratory/points/results.hpp"
#include "experiments/laboratory/points/single_worker.hpp"
#include "experiments/laboratory/points/view.hpp"
#include "experiments/laboratory/report/run_report.hpp"
#include "experiments/laboratory/report/saturation.hpp"
#include "experiments/laboratory/uncertain/confidence.hpp"
#include "experiments/laboratory/uncertain/draw.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t MOST_NOTES = 20;

void print_profile(const Simulation& s) {
  const auto column = s.table.find("rays");
  print_out("\nhost CPU time, microseconds per simulated ray beyond the kernel:\n");
  for (std::size_t i = 0; i < s.results.size(); ++i) {
    const auto& host = s.results[i].host;
    const auto& row = s.table.rows[s.table.row_of(i)];
    const double rays = column ? as_number(row[*column]).value_or(0) : 0;
    if (rays == 0 || !host.kernel_s) continue;
    print_out("  {:<40}: {:6.2f} us (kernel {:.2f} us), {:.1f} events\n", name_of(s.file.points[i]),
              (host.run_s - *host.kernel_s) / rays * 1e6, *host.kernel_s / rays * 1e6,
              static_cast<double>(host.events) / rays);
  }
}

void print_notes(const Simulation& s) {
  const auto notes = notes_of(s.file, s.results);
  for (const auto& note : notes | std::views::take(MOST_NOTES)) print_note(note);
  if (notes.size() > MOST_NOTES) print_out("...\n");
}

// Lists the final image of each point, without the images of earlier simulated times.
std::set<std::string> list_images(const Simulation& s) {
  std::set<std::string> names;
  for (const auto& result : s.results)
    for (const auto& image : result.images)
      if (!image.at_s) names.insert(image.path);
  return names;
}

void print_paths(const fs::path& output, const std::set<std::string>& images) {
  print_out("  report   {}\n", (output / "report.html").string());
  print_out("  table    {}\n", (output / "results.csv").string());
  for (const char* table : {"means.csv", "intervals.csv", "assumptions.csv", "rankings.csv"})
    if (fs::exists(output / table)) print_out("  table    {}\n", (output / table).string());
  for (const auto& image : images) print_out("  image    {}\n", (output / image).string());
  if (fs::exists(output / "plots")) print_out("  plots    {}\n", (output / "plots").string());
  if (fs::exists(output / "figures")) print_out("  figures  {}\n", (output / "figures").string());
}

void print_films(const FilmOptions& films) {
  for (const auto& film : {films.picture, films.network})
    if (!film.empty()) print_out("  film     {}\n", describe_files(film, films.frames));
}

void print_summary(const RunOptions& options, const Simulation& s) {
  const auto output = results_folder(options);
  const Table means = average_seeds(s.table);
  const auto view = choose_view(s.file, means);
  print_out("{}\n{}\n", paint(title_of(s.file), Tone::heading),
            to_text(means, view, output_width()));
  if (const auto seeds = describe_seeds(s.table); !seeds.empty()) print_out("{}\n", seeds);
  for (const auto& sentence : view.unknown) print_note(sentence);
  print_notes(s);
  if (const auto sure = load_confidence(output))
    for (const auto& sentence :
         describe_confidence(*sure, fit_columns(means, view, output_width())))
      print_out("{}\n", sentence);
  if (const auto rankings = load_rankings(output))
    for (const auto& sentence : tell_rankings(*rankings)) print_out("{}\n", sentence);
  if (s.file.uncertain.machines > 0 && !fs::exists(output / "intervals.csv"))
    print_note(fmt::format("no intervals: fewer than {} machines have completed all points",
                           LEAST_MACHINES));
  if (s.left_out > 0)
    print_note(
        fmt::format("{} of {} machines are left out, because they did not complete all points",
                    s.left_out, s.file.uncertain.machines));
  if (options.profile && s.table.find("rays")) print_profile(s);
  for (const auto& [model, speed] : s.host_speeds)
    print_out(
        "\ntimed: {:.4g} cycles a second of host CPU, spread {:.1f} % between rays, blocks "
        "and radiosity, {} repeats each\n",
        speed.cycles_per_host_s, 100 * speed.spread, speed.repeats);
  if (s.there > 0) print_out("{} of {} points were already recorded.\n", s.there, s.asked);
  print_out("Ended: {}, in {:.1f} s. {}esults in {}:\n", s.ended, s.wall_s,
            s.complete ? "R" : "Incomplete r", output.string());
  print_paths(output, list_images(s));
  print_films(options.films);
}

}  // namespace

void print_verdict(const CheckResult& check, const Table& table) {
  const auto tone = check.verdict == Verdict::holds   ? Tone::good
                    : check.verdict == Verdict::fails ? Tone::bad
                                                      : Tone::caution;
  const auto line = summarize(check, table);
  const auto word = std::string_view(line).substr(0, line.find_first_of(" "));
  print_out("{}{}\n", paint(word, tone), line.substr(word.size()));
}

namespace {

// States the saturation, and answers the questions of [[best]], in sentences. Empty if no point was
// completed.
std::vector<std::string> answer_questions(const CheckPlan& plan, const Simulation& s) {
  std::vector<std::string> sentences;
  if (const auto saturation = find_common_saturation(s.file))
    sentences = tell_saturation(s.table, *saturation);
  const auto is_done = [&](const auto& row) { return is_complete_row(s.table, row); };
  if (plan.questions.empty() || std::ranges::none_of(s.table.rows, is_done)) return sentences;
  for (const auto& answer : find_best(plan, make_rows(plan, s.file, s.table)))
    sentences.insert(sentences.end(), answer.findings.begin(), answer.findings.end());
  return sentences;
}

// Prints the answers to [[best]], the checks and the failures, after the results are written.
// Throws Failure if the user interrupted, or if a point or a check failed.
void judge(const RunOptions& options, const CheckPlan& plan, const Simulation& s) {
  const auto output = results_folder(options).string();
  for (const auto& failure : s.undrawn) complain(failure);
  if (was_interrupted())
    throw Failure(
        fmt::format("interrupted; the results so far are in {}, marked incomplete", output),
        EXIT_INTERRUPTED);
  const auto answers = answer_questions(plan, s);
  if (!s.checks.empty() || !answers.empty()) print_out("\n");
  for (const auto& note : note_unknown_texts(plan, s.table)) print_note(note);
  for (const auto& sentence : answers) print_out("{}\n", sentence);
  for (const auto& check : s.checks) print_verdict(check, s.table);
  throw_failures(s.file, s.results,
                 fmt::format("the other results are in {}, marked incomplete", output));
  const auto failed = std::ranges::count(s.checks, Verdict::fails, &CheckResult::verdict);
  if (failed > 0)
    throw Failure(fmt::format("{}: {} of {} check(s) do not hold; results are in {}", options.file,
                              failed, s.checks.size(), output),
                  EXIT_DEFECT);
  throw_undrawn(s.undrawn.size(), output);
}

void write_and_judge(const RunOptions& options, const ExperimentFile& file, Missing missing) {
  const auto plan = plan_checks(file);
  const Simulation s = simulate(options, file, plan, missing);
  print_summary(options, s);
  judge(options, plan, s);
}

// Reads a range of point numbers: "3" or "3-5".
std::pair<std::size_t, std::size_t> read_range(const std::string& text, std::size_t points) {
  const auto ends = base::split(text, '-');
  const auto first = base::parse_number<std::size_t>(ends.front());
  const auto last = base::parse_number<std::size_t>(ends.back());
  base::require(ends.size() <= 2 && first && last && *first <= *last && *last < points,
                "--point " + text,
                "expected the number of a point, or two such as 0-9, from 0 to {}", points - 1);
  return {*first, *last};
}

std::vector<std::size_t> read_numbers(const std::vector<std::string>& texts, std::size_t points) {
  std::set<std::size_t> numbers;
  for (const auto& text : texts) {
    const auto [first, last] = read_range(text, points);
    for (std::size_t i = first; i <= last; ++i) numbers.insert(i);
  }
  return {numbers.begin(), numbers.end()};
}

// Throws if a point has the setting cost = "timed". Its results depend on the speed of the host, so
// results of different hosts cannot be merged.
void check_counted(const ExperimentFile& file, const std::vector<std::size_t>& numbers) {
  for (const auto i : numbers)
    base::require(!file.points[i].experiment.is_timed, file.path,
                  "--point {}: found cost = \"timed\", expected \"counted\"", i);
}

// Prints how many of the chosen points have results, and throws if one failed.
void judge_chosen(const PointsPlan& plan, const std::vector<std::size_t>& numbers,
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
  if (was_interrupted()) throw Failure("interrupted; " + where, EXIT_INTERRUPTED);
  throw_failures(chosen, found, where);
  print_out("{}\n", where);
  print_films(plan.options.films);
}

// Throws for a name in --columns that is no column of the results.
void check_shown_columns(const RunOptions& options, const ExperimentFile& file) {
  if (std::ranges::find(options.overrides, "report.columns", &Override::key) ==
      options.overrides.end())
    return;
  auto known = declared_columns(file);
  for (const auto& baseline : file.baselines) known.push_back(baseline.column());
  for (const auto& name : file.report.columns)
    base::require(is_declared(known, name) || name == "all" || name == SEEDS, "--columns",
                  "no column \"{}\"{}", name, base::suggest(name, known));
}

}  // namespace

void run_experiment(const RunOptions& options) {
  const auto file = load_experiment(options.file, options.overrides, options.is_reduced);
  check_shown_columns(options, file);
  if (file.content->empty())
    complain(fmt::format("{}: found no keys; the program farm runs with its defaults", file.path));
  write_and_judge(options, file, Missing::run);
}

void list_points(const RunOptions& options) {
  const auto file = spread(load_experiment(options.file, options.overrides, options.is_reduced));
  const PointsPlan plan(options, file);
  const Results results = find_points(plan, all_points(file));
  for (std::size_t i = 0; i < results.size(); ++i)
    print_out("{}\t{}\t{}\t{}\n", i, plan.keys[i], name_of(file.points[i]),
              results[i].is_there() ? "there" : "missing");
}

void run_chosen_points(const RunOptions& options) {
  const auto file = spread(load_experiment(options.file, options.overrides, options.is_reduced));
  const auto numbers = read_numbers(options.points, file.points.size());
  check_counted(file, numbers);
  check_recordings(options, file, numbers.size());
  check_points(options, file);
  const auto folder = results_folder(options);
  check_results_folder(folder);
  check_same_experiment(folder, file);
  const CheckPlan checks = plan_checks(file);
  const StoreGuard guard(folder);
  const PointsPlan plan(options, file, inspect_names(checks, file), record_points(file),
                        draw_faults(file.report.figure.make_style({})));
  Results results = find_points(plan, numbers);
  std::vector<std::size_t> missing;
  for (const auto i : numbers)
    if (!results[i].is_there()) missing.push_back(i);
  run_points(plan, missing, results);
  measure_single_workers(plan, results, SingleWorker::run);
  if (missing.size() < numbers.size()) save_origin(folder, file, plan.origin);
  judge_chosen(plan, numbers, results);
}

void merge_results(const std::string& folder) {
  const Origin origin = load_origin(folder, POINTS_ORIGIN);
  write_and_judge(origin.options, origin.file, Missing::refuse);
}

}  // namespace laboratory
