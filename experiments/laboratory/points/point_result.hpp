#pragma once
// What came out of one point, and how it ended.
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

/// An image of a point: a file of the records, and where it is among the results.
struct SavedImage {
  std::string name;            ///< that the program gave it
  std::optional<double> at_s;  ///< when it was complete, for one on the way to the last
  std::string file, exr;       ///< names in the folder of records, by content; exr: "" for none
  bool is_named = false;       ///< its name says already what it shows
  std::string path = {};       ///< name in the folder of results; "" until it is placed
  std::string caption = {};
};

/// CPU seconds of the host: never part of a result.
struct HostCost {
  double total_s = 0, run_s = 0;  ///< all of the point; the simulation alone
  std::optional<double> kernel_s;
  std::uint64_t events = 0;  ///< simulated; 0 where they are not counted
};

struct PointResult {
  /// done, saturated, limit, interrupt, deadlock, out of memory or failed; "": not run.
  std::string ended;
  std::string at;        ///< names the point; only in records
  std::string message;   ///< why a point failed
  int exit_code = 0;     ///< of one that failed
  std::string topology;  ///< name of the network, where the program uses one
  int processors = 0;
  base::Row described;          ///< columns that are known before the run
  std::vector<base::Row> rows;  ///< none where nothing was measured
  std::vector<std::string> notes;
  std::vector<SavedImage> images;
  std::vector<base::Row> growth;  ///< rows of growth.csv
  nlohmann::ordered_json use;  ///< of processors and links, as run.json shows it; only in records
  nlohmann::ordered_json kernels;  ///< the same of kernels, where costs are timed
  HostCost host;
  /// Time of a single worker of the same machine, where the network says its size itself; not in
  /// records.
  std::optional<double> single_s = {};

  bool is_there() const { return !ended.empty(); }
  /// Whether the point came to its end.
  bool is_complete() const { return ended == "done" || ended == "saturated"; }
  bool is_failed() const { return !message.empty(); }
};
/// A result as JSON, for a pipe or a record, and back; throws nlohmann::json::exception.
nlohmann::ordered_json to_json(const PointResult& result);
/// A cell as a number, a text or null.
nlohmann::ordered_json to_json(const base::Cell& cell);
PointResult to_result(const nlohmann::ordered_json& json);

/// One result for each point of the file.
using Results = std::vector<PointResult>;

/// The sentences of the programs about their runs, each behind its point's name where there are
/// several points.
std::vector<std::string> notes_of(const ExperimentFile& file, const Results& results);
/// The numbers of all points, and of those without a result.
std::vector<std::size_t> all_points(const ExperimentFile& file);
std::vector<std::size_t> missing_points(const Results& results);

/// The result of a point that ended with a simulated fault or a defect, or for which the host has
/// no memory; none for any other exception.
std::optional<PointResult> make_failure(const std::exception& error);
/// The result of a point when its process has died.
PointResult make_failure(const std::string& died);

/// Why a run of so many points ended: a sentence.
std::string describe_end(const Results& results, std::size_t points);
/// Throws Failure if a point failed: with exit code 1 for a defect or a process that died, else
/// 3. `where` says what has become of the results.
void throw_failures(const ExperimentFile& file, const Results& results, const std::string& where);

}  // namespace laboratory
