#pragma once
// Options of a run, and origin of a results folder. The origin is a description of the experiment,
// written to points/experiment.json with the first record of a point.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/errors.hpp"
#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/points/run_options.hpp"

namespace laboratory {

/// The requested results folder, or results/NAME.
std::filesystem::path results_folder(const RunOptions& options);

/// Formats the command, "tlab run FILE --set ...".
std::string command_line(const RunOptions& options);

inline constexpr const char* POINTS_ORIGIN = "points/experiment.json";

/// Makes the origin, which is also a part of run.json: name, title, command line, and resolved
/// experiment. It can be read without the experiment file. Paths are relative to the results
/// folder.
nlohmann::ordered_json make_origin(const RunOptions& options, const ExperimentFile& file,
                                   const std::filesystem::path& results);

/// Throws BadInput if the results belong to another experiment: to a file with another name, or to
/// a file of the same name in another folder with another title. The message names both
/// experiments. Accepts results that record no name.
void check_same_experiment(const std::filesystem::path& results, const ExperimentFile& file);

/// Writes the origin unless it exists. Throws as check_same_experiment does, even if another
/// process writes the origin of another experiment at the same time.
void save_origin(const std::filesystem::path& results, const ExperimentFile& file,
                 const nlohmann::ordered_json& origin);

/// The experiment as it was when the results were made, and the options of that run.
struct Origin {
  RunOptions options;  ///< only file, output, overrides and until_s are set
  ExperimentFile file;
};
/// Loads the origin from POINTS_ORIGIN or run.json, and applies `overrides` after those of the run.
/// Throws BadInput if it is missing or damaged.
Origin load_origin(const std::filesystem::path& results, const std::filesystem::path& file,
                   const Overrides& overrides = {});

/// The error for a file of tlab's own that is not valid JSON, or is incomplete.
base::BadInput make_damaged(const std::filesystem::path& file,
                            const nlohmann::json::exception& error);

}  // namespace laboratory
