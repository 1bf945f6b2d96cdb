#pragma once
// The options of a run, and which experiment a folder of results belongs to:
// points/experiment.json, written with the first record of a point.
#include <filesystem>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/errors.hpp"
#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/film/film_options.hpp"

namespace laboratory {

/// The options of tlab run.
struct RunOptions {
  std::string file;                    ///< the experiment
  std::string output;                  ///< results folder; "": results/NAME
  std::vector<std::string> overrides;  ///< --set
  unsigned jobs = 1;                   ///< points run side by side, and networks drawn
  unsigned threads = 1;                ///< of a point; results do not depend on it
  bool profile = false;
  double until_s = std::numeric_limits<double>::infinity();  ///< simulated
  double from_s = 0;     ///< simulated; of trace, timeline and films
  std::string trace;     ///< file for the one point's trace: .json (Perfetto) or .paje
  std::string timeline;  ///< file for its time line: .svg
  FilmOptions films;     ///< of the one point
  bool list = false;
  std::vector<std::string> points;  ///< --point: "3" or "3-5", numbers from 0

  bool wants_trace() const { return !trace.empty() || !timeline.empty() || !films.network.empty(); }
  /// Whether a point is to be run although its results are there.
  bool runs_anew() const { return profile || wants_trace() || films.is_asked(); }
};

/// Where results go: as asked, or results/NAME.
std::filesystem::path results_folder(const RunOptions& options);

/// "tlab run FILE --set ..."
std::string command_line(const RunOptions& options);

inline constexpr const char* POINTS_ORIGIN = "points/experiment.json";

/// Makes the file's content, which is a part of run.json too: name and title, command line, and the
/// experiment as resolved, so that it can be read again without its file; files that it names are
/// found from the folder of results.
nlohmann::ordered_json make_origin(const RunOptions& options, const ExperimentFile& file,
                                   const std::filesystem::path& results);

/// Throws BadInput, with both names, where the results are of another experiment: a file of another
/// name, or another file of this name with another title. Results of programs that did not record a
/// name are taken for the same.
void check_same_experiment(const std::filesystem::path& results, const ExperimentFile& file);

/// Writes the origin of the experiment unless it is there. Throws as check_same_experiment, even if
/// another experiment has written its own at the same time.
void save_origin(const std::filesystem::path& results, const ExperimentFile& file,
                 const nlohmann::ordered_json& origin);

/// An experiment as it was when its results were made, and the options that made them.
struct Origin {
  RunOptions options;  ///< file, output, overrides, until_s
  ExperimentFile file;
};
/// Loads it from POINTS_ORIGIN or run.json. Throws BadInput where it is missing or damaged.
Origin load_origin(const std::filesystem::path& results, const std::filesystem::path& file);

/// The error for a file of ours that is no JSON, or lacks something.
base::BadInput make_damaged(const std::filesystem::path& file,
                            const nlohmann::json::exception& error);

}  // namespace laboratory
