// The report of a run: plots, tables of figures, drawings of networks, and the page.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/laboratory/points/origin.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

/// Writes report.html, plots/*.svg, plots/*.png and networks/*.svg, fits.csv, best.csv and pays.csv
/// into the folder that holds the run's images and records. Returns which drawings failed and why;
/// the page says so too. Throws what make_report throws, and std::system_error when another file
/// cannot be written.
std::vector<std::string> write_report(const std::filesystem::path& folder,
                                      const RunOptions& options, const Simulation& simulation);

/// Throws Failure with the number of drawings that failed, unless there are none.
void throw_undrawn(std::size_t undrawn, const std::string& results);

/// Does so again for the results of an earlier run, and prints where the page is. Throws
/// base::BadInput, with the file, where the folder holds no results or damaged ones; Failure, when
/// everything is written, where a drawing failed.
/// `columns` takes the place of the file's [report] columns unless it is empty; unknown ones are
/// refused.
void report_results(const std::string& folder, const std::vector<std::string>& columns);

/// The title of the experiment, else the name of its file.
std::string title_of(const ExperimentFile& file);

}  // namespace laboratory
