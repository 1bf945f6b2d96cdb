// Fuzzing: tries the readers of files with almost valid texts. tests/fuzz/run starts this program.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <tuple>
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

struct Options {
  bool command = false;
  std::vector<std::string> readers;
  std::uint64_t cases = 10'000, seed = 1;
  std::optional<std::uint64_t> only;
  double hours = 0;
  std::string keep = "build/fuzz";
  Limits limits;
};

// After this number of cases, a reader should have accepted some texts and refused others.
constexpr std::uint64_t MANY = 100;

std::vector<Reader> find_readers(const Options& o) {
  auto all = o.command ? command_readers(fs::read_symlink("/proc/self/exe").parent_path() / "tlab")
                       : all_readers();
  if (o.readers.empty()) return all;
  std::vector<std::string> known;
  for (const auto& reader : all) known.push_back(reader.name);
  for (const auto& name : o.readers)
    base::require(std::ranges::find(known, name) != known.end(), "--reader",
                  "found \"{}\", expected one of {}", name, fmt::join(known, ", "));
  std::erase_if(all, [&](const Reader& reader) {
    return std::ranges::find(o.readers, reader.name) == o.readers.end();
  });
  return all;
}

void keep_finding(const Trial& trial, const Finding& finding, const Options& o,
                  const fs::path& folder) {
  const auto& [name, number] = std::tie(trial.reader.name, finding.number);
  const auto file = folder / fmt::format("{}-{}-{}{}", name, o.seed, number, trial.reader.ending);
  fs::create_directories(folder);
  base::save_whole(file, make_case(trial, o.seed, number));
  fmt::print("{}: {}\n  {}\n  again: {}--reader {} --seed {} --only {}\n", name,
             base::make_readable(finding.what), file.string(), o.command ? "--command " : "", name,
             o.seed, number);
  std::fflush(stdout);
}

// True if no reader has failed, and each has accepted some texts. A reader that refuses every text
// is not tested.
bool print_counts(const std::vector<Trial>& trials, const Options& o) {
  fmt::print("seed {}{}\n{:>17} {:>10} {:>10} {:>10} {:>9} {:>8}\n", o.seed,
             test::IS_SANITIZED ? ", with sanitizers" : "", "reader", "cases", "accepted",
             "refused", "findings", "wall_s");
  bool good = true;
  for (const auto& [reader, corpus, counts, next, wall_s] : trials) {
    fmt::print("{:>17} {:>10} {:>10} {:>10} {:>9} {:>8.1f}\n", reader.name, counts.cases,
               counts.accepted, counts.refused, counts.findings, wall_s);
    const bool shows_nothing =
        counts.cases >= MANY && (counts.accepted == 0 || counts.refused == 0);
    if (shows_nothing) fmt::print("{}: accepted all or none, expected some\n", reader.name);
    good = good && counts.findings == 0 && !shows_nothing;
  }
  return good;
}

void add_options(CLI::App& app, Options& o) {
  app.add_flag(
      "--command", o.command,
      "tries the command with files: every 256th time in a process of tlab beside this program");
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
  // keeps temporary files in memory, which is faster than the disk
  if (fs::is_directory("/dev/shm")) setenv("TMPDIR", "/dev/shm", 0);
  const test::TemporaryFolder working;
  fs::current_path(working.path);
  std::vector<Trial> trials;
  for (const auto& reader : find_readers(o)) trials.push_back({reader, load_corpus(reader)});
  const Campaign campaign{o.seed, o.limits, [&](const Trial& trial, const Finding& finding) {
                            keep_finding(trial, finding, o, folder);
                          }};
  if (o.only)
    for (auto& trial : trials) trial.next = *o.only, run_batch(trial, 1, campaign);
  else if (o.hours > 0)
    run_hours(trials, o.hours, campaign);
  else
    run_number(trials, o.cases, campaign);
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
