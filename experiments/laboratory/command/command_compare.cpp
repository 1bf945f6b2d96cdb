// tlab compare: two runs or more, point by point.
#include <fmt/format.h>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/compare/comparison.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/report/run_report.hpp"

namespace laboratory {
namespace {

struct CompareOptions {
  std::vector<std::string> folders, columns;
  std::string output;
};

void compare(const CompareOptions& o) {
  const bool is_page = o.output.ends_with(".html");
  base::require(o.output.empty() || is_page || o.output.ends_with(".csv"), "--output",
                "found {}, expected a name that ends with .html or .csv", o.output);
  const auto comparison = compare_runs(o.folders, o.columns);
  fmt::print("{}", to_text(comparison));
  if (o.output.empty()) return;
  std::vector<std::string> undrawn;
  base::save_whole(o.output, is_page ? to_page(comparison, undrawn)
                                     : to_csv(guard_formulas(to_table(comparison))));
  for (const auto& failure : undrawn) complain(failure);
  throw_undrawn(undrawn.size(), o.output);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "compare", "what differs between the results of runs: settings, models, each point");
  auto o = std::make_shared<CompareOptions>();
  command
      ->add_option("DIR", o->folders,
                   "results folders; the others are measured by the first. Runs that differ in "
                   "seeds alone are samples")
      ->required()
      ->expected(1, 1000);
  command->add_option("--columns", o->columns, "results to compare [what is asked for most]")
      ->delimiter(',');
  command->add_option("-o,--output", o->output, "write a page, .html, or all ratios, .csv");
  command->footer(
      "Examples:\n  tlab compare results/tree results/mesh\n  tlab compare a b -o a-b.html "
      "--columns time_s,speedup");
  command->callback([o] { compare(*o); });
}

}  // namespace laboratory
