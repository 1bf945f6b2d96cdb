// tlab verify: checks experiments against their formulas and references.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <ranges>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/command/run.hpp"
#include "experiments/laboratory/file/values.hpp"
#include "experiments/laboratory/host/colour.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/judge/test_report.hpp"
#include "experiments/laboratory/options/options.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t MOST_SHOWN = 20;

struct VerifyOptions {
  std::vector<std::string> paths;  // experiment files, or folders of them
  // options of each run; `output` is the results folder, or its parent if there are several
  // experiments
  RunOptions run;
  bool all = false;        // show every point of a check instead of only the worst ones
  std::string junit, tap;  // report files for CI systems; "": no such file
};

struct Candidate {
  std::string file;
  fs::path name;  // name of the results folder inside the output folder
  // true if the user named the file itself, false if the user named a folder that contains it
  bool named = false;
};

std::vector<Candidate> find_candidates(const std::string& path) {
  if (!fs::is_directory(path)) return {{path, fs::path(path).stem(), true}};
  std::vector<Candidate> candidates;
  for (const auto& entry : fs::recursive_directory_iterator(path))
    if (entry.is_regular_file() && entry.path().extension() == ".toml")
      candidates.push_back(
          {entry.path().string(), entry.path().lexically_relative(path).replace_extension()});
  base::require(!candidates.empty(), path,
                "found no experiment file (*.toml) in this folder, expected at least one");
  std::ranges::sort(candidates, {}, [](const Candidate& c) { return fs::path(c.file); });
  return candidates;
}

struct Verified {
  std::vector<TestCase> cases = {};  // one for each check, in the order of the files
  std::size_t undrawn = 0;

  std::size_t count_holding() const {
    return static_cast<std::size_t>(
        std::ranges::count(cases, TestOutcome::passed, &TestCase::outcome));
  }
};

void save_reports(const VerifyOptions& options, const Verified& verified) {
  if (!options.junit.empty()) base::save_whole(options.junit, make_junit(verified.cases));
  if (!options.tap.empty()) base::save_whole(options.tap, make_tap(verified.cases));
}

void print_check(const CheckResult& check, const Table& table, std::size_t most) {
  print_verdict(check, table);
  if (!check.points.empty()) print_out("{}", to_text(make_check_table(check, table, most)));
  if (check.points.size() > most)
    print_out("the worst of {} points; --all shows every point\n", check.points.size());
  for (const auto& note : check.notes) print_note(note);
  print_out("\n");
}

void verify_file(const Candidate& candidate, const VerifyOptions& options, bool alone,
                 Verified& verified) {
  if (!candidate.named &&
      !base::parse_toml(base::read_text(candidate.file), candidate.file).contains("check"))
    return print_out("{}: no checks, skipped\n\n", candidate.file);
  const ExperimentFile file =
      load_experiment(candidate.file, options.run.overrides, options.run.is_reduced);
  if (file.checks.empty()) return print_out("{}: no checks, skipped\n\n", candidate.file);
  const CheckPlan plan = plan_checks(file);
  RunOptions run = options.run;
  run.file = candidate.file;
  if (!alone || run.output.empty())
    run.output = (fs::path(run.output.empty() ? "results" : run.output) / candidate.name).string();
  const Simulation s = simulate(run, file, plan);
  if (was_interrupted()) throw Interrupted();
  print_out("{}: {} point(s), results {} {}\n\n", candidate.file, s.results.size(),
            s.there == s.results.size() ? "were in" : "are now in", run.output);
  for (const auto& note : note_unknown_texts(plan, s.table)) print_note(note);
  const auto most = options.all ? std::numeric_limits<std::size_t>::max() : MOST_SHOWN;
  for (const auto& check : s.checks) {
    print_check(check, s.table, most);
    verified.cases.push_back(make_test_case(candidate.file, check, s.table, most));
  }
  for (const auto& failure : s.undrawn) complain(failure);
  verified.undrawn += s.undrawn.size();
  throw_failures(s.file, s.results, "the other results are in " + run.output);
}

// Verifies an experiment. If an error prevents the verification, saves the CI reports of the
// results so far, and then rethrows the error.
void verify_and_report(const Candidate& candidate, const VerifyOptions& options, bool alone,
                       Verified& verified) {
  try {
    verify_file(candidate, options, alone, verified);
  } catch (const Interrupted&) {
    throw;
  } catch (const std::exception& error) {
    verified.cases.push_back({candidate.file, "run", TestOutcome::error, error.what(), ""});
    save_reports(options, verified);
    throw;
  }
}

// Runs the experiments and prints every check with its points. Then throws Failure if a check fails
// or applies to no point, or if a given file or folder contains no check.
void verify(const VerifyOptions& options) {
  std::vector<std::vector<Candidate>> candidates;
  for (const auto& path : options.paths) candidates.push_back(find_candidates(path));
  for (const auto& candidate : candidates | std::views::join) base::check_can_read(candidate.file);
  check_can_save_all({options.junit, options.tap});
  const bool alone = candidates.size() == 1 && candidates[0][0].named;
  Verified verified;
  std::vector<std::string> without;  // files and folders without checks
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto before = verified.cases.size();
    for (const auto& candidate : candidates[i])
      verify_and_report(candidate, options, alone, verified);
    if (verified.cases.size() == before) without.push_back(options.paths[i]);
  }
  save_reports(options, verified);
  const auto hold = verified.count_holding(), fail = verified.cases.size() - hold;
  print_out("{} check(s) hold, {} do not\n", hold, fail);
  if (fail > 0)
    throw Failure(fmt::format("{} of {} check(s) do not hold", fail, verified.cases.size()),
                  EXIT_DEFECT);
  if (!without.empty())
    throw Failure(
        fmt::format("{}: found no [[check]], expected at least one", fmt::join(without, ", ")),
        EXIT_DEFECT);
  if (verified.undrawn > 0)
    throw Failure(fmt::format("{} drawing(s) failed", verified.undrawn), EXIT_HOST);
}

}  // namespace

void add_verify_command(CLI::App& app) {
  auto* command =
      app.add_subcommand("verify", "compare experiments with their formulas and references");
  auto o = std::make_shared<VerifyOptions>();
  command->add_option("PATH", o->paths, "experiment files (TOML), or folders with such files")
      ->required();
  add_run_options(*command, o->run,
                  "results folder of a single file, or folder for all results [results]",
                  "key.path=value: replaces a key of each experiment");
  command->add_flag("--all", o->all, "show every point instead of only the worst");
  command->add_option("--junit", o->junit, "write a case for each check as JUnit XML")
      ->check(check_file_name);
  command->add_option("--tap", o->tap, "write a case for each check in the Test Anything Protocol")
      ->check(check_file_name);
  command->footer(
      "Examples:\n  tlab verify experiments/farm.toml\n  tlab verify experiments/thesis -o "
      "results/thesis");
  command->callback([o] {
    check_apart("--tap", o->tap, {o->junit});
    verify(*o);
  });
}

}  // namespace laboratory
