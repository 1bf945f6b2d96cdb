#pragma once
// The result of one point, and how its simulation ended.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// An image of a point: a file of the records, and its place among the results.
struct SavedImage {
  std::string name;            ///< given by the program
  std::optional<double> at_s;  ///< simulated time of completion, for intermediate images
  std::string file, exr;       ///< names in the folder of records, by content; exr: "" for none
  bool is_named = false;       ///< the name already describes the content
  std::string path = {};       ///< name in the folder of results; "" until it is placed
  std::string caption = {};
};

/// CPU seconds of the host: never part of a result.
struct HostCost {
  double total_s = 0, run_s = 0;  ///< whole point; simulation only
  std::optional<double> kernel_s;
  std::uint64_t events = 0;  ///< simulated; 0 if not counted
};

struct PointResult {
  /// done, saturated, limit, interrupt, deadlock, out of memory or failed; "": not run.
  std::string ended;
  std::string at;        ///< names the point; only in records
  std::string message;   ///< the reason of a failure
  int exit_code = 0;     ///< of a failed point
  std::string topology;  ///< name of the network, if the program uses one
  int processors = 0;
  base::Row described;          ///< columns known before the run
  std::vector<base::Row> rows;  ///< empty if nothing was measured
  std::vector<std::string> notes;
  std::vector<SavedImage> images;
  std::vector<base::Row> growth;   ///< rows of growth.csv
  nlohmann::ordered_json use;      ///< loads of processors and links; only in records
  nlohmann::ordered_json kernels;  ///< the same for kernels, if costs are timed
  HostCost host;
  /// Time of a single worker of the same machine, for networks that define their own size; not in
  /// records.
  std::optional<double> single_s = {};

  bool is_there() const { return !ended.empty(); }
  /// True if the point was completed.
  bool is_complete() const { return ended == "done" || ended == "saturated"; }
  bool is_failed() const { return !message.empty(); }
};
/// Converts a result to JSON, for a pipe or a record, and back; throws nlohmann::json::exception.
nlohmann::ordered_json to_json(const PointResult& result);
/// A cell as a number, a text or null.
nlohmann::ordered_json to_json(const base::Cell& cell);
PointResult to_result(const nlohmann::ordered_json& json);

/// One result for each point of the file.
using Results = std::vector<PointResult>;

/// The programs' sentences about their runs, each prefixed with its point's name if there are
/// several points.
std::vector<std::string> notes_of(const ExperimentFile& file, const Results& results);
/// The numbers of all points, and of points without a result.
std::vector<std::size_t> all_points(const ExperimentFile& file);
std::vector<std::size_t> missing_points(const Results& results);

/// The result of a point that ended with a simulated fault, a defect, or a lack of host memory;
/// none for any other exception.
std::optional<PointResult> make_failure(const std::exception& error);
/// The result of a point whose process died.
PointResult make_failure(const std::string& died);

/// The reason why a run of so many points ended, a sentence.
std::string describe_end(const Results& results, std::size_t points);
/// Throws Failure if a point failed: with exit code 1 for a defect or a process that died, else 3.
/// `where` describes the state of the results.
void throw_failures(const ExperimentFile& file, const Results& results, const std::string& where);

}  // namespace laboratory
