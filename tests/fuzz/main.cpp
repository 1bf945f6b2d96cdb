// Tries the readers of files with texts that are nearly right: tests/fuzz/run.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "base/errors.hpp"
#include "base/message.hpp"
#include "base/whole_file.hpp"
#include "tests/fuzz/campaign.hpp"
#include "tests/support/files.hpp"
#include "tests/support/isolated.hpp"

namespace fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

struct Options {
  std::vector<std::string> readers;
  std::uint64_t cases = 10'000, seed = 1;
  std::optional<std::uint64_t> only;
  double hours = 0;
  std::string keep = "build/fuzz";
  Limits limits;
};

// A reader after so many findings is not tried further: they are likely to be of few kinds.
constexpr std::uint64_t MOST_FINDINGS = 20;
constexpr std::uint64_t BATCH = 500;
// So many cases of which a reader accepts none, or refuses none, show nothing.
constexpr std::uint64_t MANY = 100;

struct Trial {
  Reader reader;
  Corpus corpus;
  Counts counts;
  std::uint64_t next = 0;  // case
  double wall_s = 0;
};

std::vector<Trial> make_trials(const Options& o) {
  std::vector<std::string> known;
  for (const auto& reader : all_readers()) known.push_back(reader.name);
  for (const auto& name : o.readers)
    base::require(std::ranges::find(known, name) != known.end(), "--reader",
                  "found \"{}\", expected one of {}", name, fmt::join(known, ", "));
  std::vector<Trial> trials;
  for (auto& reader : all_readers())
    if (o.readers.empty() || std::ranges::find(o.readers, reader.name) != o.readers.end())
      trials.push_back({reader, load_corpus(reader), {}});
  return trials;
}

void keep_finding(const Trial& trial, const Finding& finding, const Options& o,
                  const fs::path& folder) {
  const auto file = folder / fmt::format("{}-{}-{}{}", trial.reader.name, o.seed, finding.number,
                                         trial.reader.ending);
  fs::create_directories(folder);
  base::save_whole(file, make_case(trial.reader, trial.corpus, o.seed, finding.number));
  fmt::print("{}: {}\n  {}\n  again: --reader {} --seed {} --only {}\n", trial.reader.name,
             base::make_readable(finding.what), file.string(), trial.reader.name, o.seed,
             finding.number);
  std::fflush(stdout);
}

void run_batch(Trial& trial, std::uint64_t cases, const Options& o, const fs::path& folder) {
  const auto begin = Clock::now();
  const auto finding =
      run_cases(trial.reader, trial.corpus, o.seed, trial.next, cases, o.limits, trial.counts);
  trial.next = finding ? finding->number + 1 : trial.next + cases;
  if (finding) keep_finding(trial, *finding, o, folder);
  trial.wall_s += std::chrono::duration<double>(Clock::now() - begin).count();
}

void run_number(std::vector<Trial>& trials, const Options& o, const fs::path& folder) {
  for (auto& trial : trials)
    while (trial.next < o.cases && trial.counts.findings < MOST_FINDINGS)
      run_batch(trial, std::min(BATCH, o.cases - trial.next), o, folder);
}

// Gives all readers the same time.
void run_hours(std::vector<Trial>& trials, const Options& o, const fs::path& folder) {
  const auto end = Clock::now() + std::chrono::duration<double>(3600 * o.hours);
  while (Clock::now() < end) {
    Trial* least = nullptr;
    for (auto& trial : trials)
      if (trial.counts.findings < MOST_FINDINGS && (!least || trial.wall_s < least->wall_s))
        least = &trial;
    if (!least) return;
    run_batch(*least, BATCH, o, folder);
  }
}

// Whether every reader stood every case, and accepted some: one that refuses all shows nothing.
bool print_counts(const std::vector<Trial>& trials, const Options& o) {
  fmt::print("seed {}{}\n{:>12} {:>10} {:>10} {:>10} {:>9} {:>8}\n", o.seed,
             test::IS_SANITIZED ? ", with sanitizers" : "", "reader", "cases", "accepted",
             "refused", "findings", "wall_s");
  bool good = true;
  for (const auto& [reader, corpus, counts, next, wall_s] : trials) {
    fmt::print("{:>12} {:>10} {:>10} {:>10} {:>9} {:>8.1f}\n", reader.name, counts.cases,
               counts.accepted, counts.refused, counts.findings, wall_s);
    const bool shows_nothing =
        counts.cases >= MANY && (counts.accepted == 0 || counts.refused == 0);
    if (shows_nothing) fmt::print("{}: accepted all or none, expected some\n", reader.name);
    good = good && counts.findings == 0 && !shows_nothing;
  }
  return good;
}

void add_options(CLI::App& app, Options& o) {
  app.add_option("--reader", o.readers, "only these readers")->delimiter(',');
  auto* cases = app.add_option("--cases", o.cases, "for each reader")->capture_default_str();
  app.add_option("--hours", o.hours, "as many cases as this takes, in place of --cases")
      ->excludes(cases)
      ->check(CLI::PositiveNumber);
  app.add_option("--seed", o.seed, "of all that is random")->capture_default_str();
  app.add_option("--only", o.only, "does one case again");
  app.add_option("--keep", o.keep, "folder for texts that a reader did not stand")
      ->capture_default_str();
  app.add_option("--cpu", o.limits.cpu_s, "most seconds of the processor for a case")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
}

int run(const Options& o) {
  const fs::path folder = fs::absolute(o.keep);
  auto trials = make_trials(o);
  const test::TemporaryFolder working;
  fs::current_path(working.path);
  if (o.only)
    for (auto& trial : trials) trial.next = *o.only, run_batch(trial, 1, o, folder);
  else if (o.hours > 0)
    run_hours(trials, o, folder);
  else
    run_number(trials, o, folder);
  fs::current_path("/");
  return print_counts(trials, o) ? 0 : 1;
}

}  // namespace
}  // namespace fuzz

int main(int argc, char** argv) {
  CLI::App app("try the readers of files with texts that are nearly right");
  fuzz::Options options;
  if (test::IS_SANITIZED) options.limits.cpu_s *= 6;
  fuzz::add_options(app, options);
  try {
    app.parse(argc, argv);
    return fuzz::run(options);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
