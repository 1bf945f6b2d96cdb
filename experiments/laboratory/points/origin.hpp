#pragma once
// The origin of a results folder: the description of the experiment that made it. It is written to
// points/experiment.json together with the first record of a point.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/errors.hpp"
#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/points/run_options.hpp"

namespace laboratory {

/// The results folder that the user gave, or results/NAME, where NAME is that of the experiment
/// file.
std::filesystem::path results_folder(const RunOptions& options);

/// Formats the command that makes the results: "tlab run FILE --set ...".
std::string command_line(const RunOptions& options);

inline constexpr const char* POINTS_ORIGIN = "points/experiment.json";

/// Makes the origin, which is also a part of run.json: name, title, command line, and the
/// experiment with all overrides applied. The origin can be read without the experiment file. Paths
/// are relative to the results folder.
nlohmann::ordered_json make_origin(const RunOptions& options, const ExperimentFile& file,
                                   const std::filesystem::path& results);

/// Throws BadInput if the results belong to another experiment, with both experiments in the
/// message. Another experiment has another file name, or the same file name but another folder and
/// title. Accepts results that record no name.
void check_same_experiment(const std::filesystem::path& results, const ExperimentFile& file);

/// Writes the origin, unless it exists. Throws as check_same_experiment() does, even if another
/// process writes the origin of another experiment at the same time.
void save_origin(const std::filesystem::path& results, const ExperimentFile& file,
                 const nlohmann::ordered_json& origin);

/// The experiment as it was when the results were made, and the options of that run.
struct Origin {
  RunOptions options;  ///< only file, output, overrides and until_s are set
  ExperimentFile file;
};
/// Loads the origin from `file`, which is POINTS_ORIGIN or run.json. Applies `overrides` after the
/// overrides of the run. Throws BadInput if the file is missing or damaged.
Origin load_origin(const std::filesystem::path& results, const std::filesystem::path& file,
                   const Overrides& overrides = {});

/// Makes the error for a file written by tlab that is no valid JSON, or incomplete.
base::BadInput make_damaged(const std::filesystem::path& file,
                            const nlohmann::json::exception& error);

}  // namespace laboratory
