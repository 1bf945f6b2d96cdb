#pragma once
// The result of one point, and how its simulation ended.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// An image of a point: its files beside the records, and its file among the results.
struct SavedImage {
  std::string name;  ///< name given by the program
  /// simulated time, in seconds, at which an intermediate image was complete; none for a final
  /// image
  std::optional<double> at_s;
  /// Names of the image's PNG file and EXR file, which lie beside the records. A name is the hash
  /// of the file's content. `exr` is "" if there is no EXR file.
  std::string file, exr;
  bool is_named = false;  ///< true if the name alone describes the content, as for key images
  std::string path = {};  ///< file name in the results folder; "" until place_images() sets it
  std::string caption = {};
};

/// CPU time on the host, in seconds. It is never part of results.csv.
struct HostCost {
  double total_s = 0, run_s = 0;  ///< CPU time of the whole point, and of its simulation alone
  std::optional<double> kernel_s;
  std::uint64_t events = 0;  ///< number of simulated events; 0: not counted
};

struct PointResult {
  /// How the simulation ended: "done", "saturated", "limit", "interrupt", "deadlock", "out of
  /// memory" or "failed"; "": it did not run.
  std::string ended;
  std::string at;                      ///< name of the point, for people who read the record
  std::string message;                 ///< reason of a failure, for the user
  int exit_code = 0;                   ///< exit code after a failure
  std::optional<double> fault_s = {};  ///< simulated time of a fault; not in records
  std::string topology;                ///< name of the network, if the program uses one
  int processors = 0;
  base::Row described;  ///< values of result columns that are known before the simulation
  /// measured rows of the results table; empty if nothing was measured
  std::vector<base::Row> rows;
  std::vector<std::string> notes;
  std::vector<SavedImage> images;
  std::vector<base::Row> growth;     ///< rows of growth.csv
  std::vector<base::Row> histogram;  ///< rows of histogram.csv
  /// loads of processors and links; only in records, null otherwise
  nlohmann::ordered_json use;
  /// counts and times of kernels (the numerical code); only if costs are timed
  nlohmann::ordered_json kernels;
  HostCost host;
  /// Simulated time in seconds with a single worker on the same machine, the basis of the speed-up.
  /// Only for networks that define their own size. Not stored in records.
  std::optional<double> single_s = {};

  bool is_there() const { return !ended.empty(); }
  /// True if the point was completed.
  bool is_complete() const { return ended == "done" || ended == "saturated"; }
  bool is_failed() const { return !message.empty(); }
};
/// Converts a result to JSON, for pipes and records; to_result() converts it back, and throws
/// nlohmann::json::exception for invalid input.
nlohmann::ordered_json to_json(const PointResult& result);
/// Converts a cell to a number, a string or null.
nlohmann::ordered_json to_json(const base::Cell& cell);
PointResult to_result(const nlohmann::ordered_json& json);

/// One result for each point of the file.
using Results = std::vector<PointResult>;

/// Notes of the programs about their simulations. If there are several points, each note begins
/// with the point's name.
std::vector<std::string> notes_of(const ExperimentFile& file, const Results& results);
/// The numbers, from 0, of all points, and of the points without a result.
std::vector<std::size_t> all_points(const ExperimentFile& file);
std::vector<std::size_t> missing_points(const Results& results);

/// Makes the result of a point whose simulation ended with a simulated fault, a defect, or a lack
/// of host memory. No value for other exceptions.
std::optional<PointResult> make_failure(const std::exception& error);
/// Makes the result of a point whose process died for the reason `died`.
PointResult make_failure(const std::string& died);

/// Describes in a sentence why a run with `points` points ended.
std::string describe_end(const Results& results, std::size_t points);
/// Throws Failure if a point failed: with exit code 1 for a defect or a process that died, else 3.
/// The text `where` tells the user in what state the results are.
void throw_failures(const ExperimentFile& file, const Results& results, const std::string& where);

}  // namespace laboratory
