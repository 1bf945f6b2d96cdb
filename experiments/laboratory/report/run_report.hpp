// Makes the report of a run: plots, tables, drawings of networks, and the page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

/// Writes report.html, plots/*.svg, plots/*.png, networks/*.svg, figures/*, fits.csv, best.csv and
/// pays.csv into the folder with the run's images and records. Returns the failed drawings with
/// reasons, which the page shows too. Throws as make_report does, and std::system_error if another
/// file cannot be written.
std::vector<std::string> write_report(const std::filesystem::path& folder,
                                      const RunOptions& options, const Simulation& simulation);

/// Throws Failure with the number of drawings that failed, unless it is 0.
void throw_undrawn(std::size_t undrawn, const std::string& results);

/// Writes the report again for the results of an earlier run, and prints the location of the page.
/// `columns` replaces the file's [report] columns unless it is empty. The keys of `figure` replace
/// those of [report] and of each [[plot]]. Throws base::BadInput for unknown columns, and for a
/// folder with no results or damaged ones. After writing everything, throws Failure if a drawing
/// failed.
void report_results(const std::string& folder, const std::vector<std::string>& columns,
                    const FigureSpec& figure = {});

/// The title of the experiment, or the name of its file if it has no title.
std::string title_of(const ExperimentFile& file);

}  // namespace laboratory
