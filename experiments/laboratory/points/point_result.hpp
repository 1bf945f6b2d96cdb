#pragma once
// Result of one point, and how its simulation ended.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// An image of a point: its files among the records, and its place among the results.
struct SavedImage {
  std::string name;            ///< name given by the program
  std::optional<double> at_s;  ///< for an intermediate image: simulated time of its completion
  std::string file, exr;  ///< file names among the records, made from the content; exr: "" for none
  bool is_named = false;  ///< true if the name alone describes the content
  std::string path = {};  ///< file name in the results folder; "" until it is placed
  std::string caption = {};
};

/// CPU time on the host, in seconds. Never part of results.
struct HostCost {
  double total_s = 0, run_s = 0;  ///< CPU time of the whole point, and of its simulation alone
  std::optional<double> kernel_s;
  std::uint64_t events = 0;  ///< number of simulated events; 0: not counted
};

struct PointResult {
  /// How the simulation ended: done, saturated, limit, interrupt, deadlock, out of memory or
  /// failed; "": not run.
  std::string ended;
  std::string at;        ///< name of the point, for people who read the record
  std::string message;   ///< reason of a failure, for the user
  int exit_code = 0;     ///< exit code after a failure
  std::string topology;  ///< name of the network, if the program uses one
  int processors = 0;
  base::Row described;          ///< result columns known before the run
  std::vector<base::Row> rows;  ///< measured rows; empty if nothing was measured
  std::vector<std::string> notes;
  std::vector<SavedImage> images;
  std::vector<base::Row> growth;   ///< rows of growth.csv
  nlohmann::ordered_json use;      ///< loads of processors and links, only in records
  nlohmann::ordered_json kernels;  ///< counts and times of kernels, only if costs are timed
  HostCost host;
  /// Time of the same machine with a single worker, in s. Only for networks that define their own
  /// size; not in records.
  std::optional<double> single_s = {};

  bool is_there() const { return !ended.empty(); }
  /// True if the point was completed.
  bool is_complete() const { return ended == "done" || ended == "saturated"; }
  bool is_failed() const { return !message.empty(); }
};
/// Conversion of a result to JSON and back, for pipes and records. Throws nlohmann::json::exception
/// for invalid input.
nlohmann::ordered_json to_json(const PointResult& result);
/// Converts a cell to a number, a string or null.
nlohmann::ordered_json to_json(const base::Cell& cell);
PointResult to_result(const nlohmann::ordered_json& json);

/// One result for each point of the file.
using Results = std::vector<PointResult>;

/// Notes of the programs about their runs. If there are several points, each note begins with the
/// point's name.
std::vector<std::string> notes_of(const ExperimentFile& file, const Results& results);
/// The numbers of all points, and of points without a result.
std::vector<std::size_t> all_points(const ExperimentFile& file);
std::vector<std::size_t> missing_points(const Results& results);

/// The result of a point whose simulation ended with a simulated fault, a defect, or a lack of host
/// memory; none for other exceptions.
std::optional<PointResult> make_failure(const std::exception& error);
/// The result of a point whose process died for the reason `died`.
PointResult make_failure(const std::string& died);

/// Describes in a sentence why a run of `points` points ended.
std::string describe_end(const Results& results, std::size_t points);
/// Throws Failure if a point failed: exit code 1 for a defect or a process that died, else 3.
/// `where` describes the state of the results.
void throw_failures(const ExperimentFile& file, const Results& results, const std::string& where);

}  // namespace laboratory
