#pragma once
// Options of a run, and the origin of a results folder: its experiment, recorded in
// points/experiment.json together with the first record of a point.
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
  unsigned jobs = 1;                   ///< parallel jobs: points to run, and networks to draw
  unsigned threads = 1;                ///< for each point; results do not depend on it
  bool profile = false;
  double until_s = std::numeric_limits<double>::infinity();  ///< simulated
  double from_s = 0;     ///< simulated; start of trace, timeline and films
  std::string trace;     ///< file for the trace of the only point: .json (Perfetto) or .paje
  std::string timeline;  ///< file for its time line: .svg
  FilmOptions films;     ///< of the only point
  bool list = false;
  std::vector<std::string> points;  ///< --point: "3" or "3-5", numbers from 0

  bool wants_trace() const { return !trace.empty() || !timeline.empty() || !films.network.empty(); }
  /// True if points are simulated even if they have results.
  bool runs_anew() const { return profile || wants_trace() || films.is_asked(); }
};

/// The requested results folder, or results/NAME.
std::filesystem::path results_folder(const RunOptions& options);

/// "tlab run FILE --set ..."
std::string command_line(const RunOptions& options);

inline constexpr const char* POINTS_ORIGIN = "points/experiment.json";

/// Makes the file's content, also a part of run.json: name and title, command line, and the
/// resolved experiment, readable without its original file. Paths are relative to the results
/// folder.
nlohmann::ordered_json make_origin(const RunOptions& options, const ExperimentFile& file,
                                   const std::filesystem::path& results);

/// Throws BadInput, with both names, if the results belong to another experiment: a file of another
/// name, or one of this name with another title. Accepts results of programs that recorded no name.
void check_same_experiment(const std::filesystem::path& results, const ExperimentFile& file);

/// Writes the origin of the experiment unless it exists. Throws as check_same_experiment does, even
/// if another experiment writes its own at the same time.
void save_origin(const std::filesystem::path& results, const ExperimentFile& file,
                 const nlohmann::ordered_json& origin);

/// An experiment with its state when its results were made, and the options of that run.
struct Origin {
  RunOptions options;  ///< file, output, overrides, until_s
  ExperimentFile file;
};
/// Loads it from POINTS_ORIGIN or run.json. Throws BadInput if it is missing or damaged.
Origin load_origin(const std::filesystem::path& results, const std::filesystem::path& file);

/// The error for one of our files that is not JSON, or incomplete.
base::BadInput make_damaged(const std::filesystem::path& file,
                            const nlohmann::json::exception& error);

}  // namespace laboratory
