// tlab compare: compares two or more runs, point by point, or two pictures.
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/errors.hpp"
#include "base/whole_file.hpp"
#include "experiments/laboratory/command/commands.hpp"
#include "experiments/laboratory/compare/compare_images.hpp"
#include "experiments/laboratory/compare/comparison.hpp"
#include "experiments/laboratory/host/jobs.hpp"
#include "experiments/laboratory/host/link_files.hpp"
#include "experiments/laboratory/host/streams.hpp"
#include "experiments/laboratory/options/options.hpp"

namespace laboratory {
namespace {

namespace fs = std::filesystem;

struct CompareOptions {
  std::vector<std::string> folders, columns;
  std::string output;
  FigureSpec figure;

  // Folder of figures for papers: a-b-figures for the page a-b.html.
  fs::path figures() const { return fs::path(output).replace_extension().string() + "-figures"; }
};

// Throws unless the output has the extension .html or .csv, can be written, and lies outside the
// results folders that are compared.
void check_target(const CompareOptions& o) {
  base::require(o.output.ends_with(".html") || o.output.ends_with(".csv"), "--output",
                "found {}, expected a name that ends with .html or .csv", o.output);
  base::check_can_save(o.output);
  const auto within = fs::weakly_canonical(fs::absolute(o.output)).parent_path();
  for (const auto& folder : o.folders) {
    const auto below = within.lexically_relative(fs::weakly_canonical(fs::absolute(folder)));
    base::require(below.empty() || *below.begin() == "..", "--output",
                  "found {}, expected a file outside the compared results", o.output);
  }
}

void compare_pictures(const CompareOptions& o) {
  base::require(o.folders.size() == 2 && std::ranges::all_of(o.folders, is_image), "compare",
                "found {}, expected two .png or .exr files, or folders of results",
                fmt::join(o.folders, ", "));
  base::require(o.columns.empty(), "--columns", "found pictures, expected folders of results");
  if (!o.output.empty()) {
    base::require(o.output.ends_with(".png") || o.output.ends_with(".exr"), "--output",
                  "found {}, expected a name that ends with .png or .exr", o.output);
    base::check_can_save(o.output);
  }
  const auto pair = compare_images(o.folders[0], o.folders[1]);
  print_out("{}", to_text(pair));
  if (o.output.empty()) return;
  const double factor = save_difference(o.output, pair);
  print_out("picture  {}: differences multiplied by {:.4g}\n", o.output, factor);
}

// Writes the page, and the figures if they are asked for.
void write_page(const CompareOptions& o, const Comparison& comparison,
                std::vector<std::string>& undrawn) {
  const PaperFigures figures{o.figure.make_style({}), o.figures()};
  if (figures.style.is_figure()) make_folders(figures.folder);
  base::save_whole(o.output, to_page(comparison, figures, undrawn));
}

void compare(const CompareOptions& o) {
  base::require(!o.figure.make_style({}).is_figure() || o.output.ends_with(".html"), "--width",
                "found no page, expected --output with a name that ends with .html");
  if (std::ranges::any_of(o.folders, is_image)) return compare_pictures(o);
  if (!o.output.empty()) check_target(o);
  const auto comparison = compare_runs(o.folders, o.columns);
  print_out("{}", to_text(comparison));
  if (o.output.empty()) return;
  std::vector<std::string> undrawn;
  const bool is_page = o.output.ends_with(".html");
  if (is_page)
    write_page(o, comparison, undrawn);
  else
    base::save_whole(o.output,
                     to_csv(guard_formulas(list_ratios(comparison.matched, comparison.columns))));
  print_out("\n{}    {}\n", is_page ? "page " : "table", o.output);
  if (fs::is_directory(o.figures()) && o.figure.make_style({}).is_figure())
    print_out("figures  {}\n", o.figures().string());
  for (const auto& failure : undrawn) complain(failure);
  if (!undrawn.empty())
    throw Failure(
        fmt::format("{} drawing(s) failed; the other results are in {}", undrawn.size(), o.output),
        EXIT_HOST);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  auto* command = app.add_subcommand(
      "compare", "compare the results of runs: settings, models and every point; or two pictures");
  auto o = std::make_shared<CompareOptions>();
  command
      ->add_option("DIR", o->folders,
                   "two or more results folders, each compared with the first; rows that differ "
                   "only in the seed are samples; or two pictures, .png or .exr")
      ->required()
      ->expected(1, 1000)
      ->option_text("... REQUIRED");
  add_names_option(
      *command, "--columns", [o](auto names) { o->columns = std::move(names); },
      "results to compare [those in the table of the first folder]");
  command
      ->add_option("-o,--output", o->output,
                   "write a page (.html) or all ratios (.csv); of pictures, a picture of the "
                   "differences (.png, .exr)")
      ->check(check_file_name);
  add_figure_options(*command, o->figure);
  for (const char* name : {"--font", "--font-size"})
    command->get_option(name)->needs(command->get_option("--width"));
  command->footer(
      "Examples:\n  tlab compare results/tree results/mesh\n  tlab compare a b -o a-b.html "
      "--columns time_s,speedup\n  tlab compare a.png b.png -o difference.png");
  command->callback([o] { compare(*o); });
}

}  // namespace laboratory
