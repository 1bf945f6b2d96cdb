// The report of a run: plots, tables of figures, drawings of networks, and the page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

/// Writes report.html, plots/*.svg, plots/*.png and networks/*.svg, fits.csv, best.csv and pays.csv
/// into the folder of the run's images and records. Returns the failed drawings with reasons, which
/// the page shows too. Throws the exceptions of make_report, and std::system_error if another file
/// cannot be written.
std::vector<std::string> write_report(const std::filesystem::path& folder,
                                      const RunOptions& options, const Simulation& simulation);

/// Throws Failure with the number of failed drawings, if not 0.
void throw_undrawn(std::size_t undrawn, const std::string& results);

/// Writes the report again for the results of an earlier run, and prints the location of the page.
/// Throws base::BadInput, with the file, if the folder holds no results or damaged ones; Failure,
/// after writing everything, if a drawing failed. `columns` replaces the file's [report] columns
/// unless it is empty; unknown ones are refused.
void report_results(const std::string& folder, const std::vector<std::string>& columns);

/// The title of the experiment, else the name of its file.
std::string title_of(const ExperimentFile& file);

}  // namespace laboratory
