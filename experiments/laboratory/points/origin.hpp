#pragma once
// Which experiment a folder of results belongs to: points/experiment.json, written with the first
// record of a point.
#include <filesystem>
#include <nlohmann/json.hpp>

#include "experiments/laboratory/file/experiment.hpp"
#include "experiments/laboratory/points/run_options.hpp"

namespace laboratory {

inline constexpr const char* POINTS_ORIGIN = "points/experiment.json";

// The file's content, and a part of run.json: name and title, command line, and the experiment as
// resolved, so that it can be read again without its file; files that it names are found from the
// folder of results.
nlohmann::ordered_json make_origin(const RunOptions& options, const ExperimentFile& file,
                                   const std::filesystem::path& results);

// Writes it unless it is there.
void save_origin(const std::filesystem::path& results, const nlohmann::ordered_json& origin);

// Throws base::BadInput, with both names, where the results are of another experiment: a
// file of another name, or another file of this name with another title. Results of programs that
// did not record a name are taken for the same.
void check_same_experiment(const std::filesystem::path& results, const ExperimentFile& file);

// An experiment as it was when its results were made, and the options that made them.
struct Origin {
  RunOptions options;  // file, output, overrides, until_s
  ExperimentFile file;
};
// From POINTS_ORIGIN or run.json. Throws base::BadInput where it is missing or damaged.
Origin load_origin(const std::filesystem::path& results, const std::filesystem::path& file);

}  // namespace laboratory
