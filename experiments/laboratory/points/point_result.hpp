#pragma once
// What came out of the points of an experiment, and how they ended.
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"

namespace laboratory {

// Of each point what farm_run or pattern_run returns, but "use", which only its record has. Null
// for a point that has not been run. Of one that failed: "ended" (deadlock, out of memory, failed),
// "message", "exit_code", an empty "row", and what its axes need.
using Results = std::vector<nlohmann::ordered_json>;

// Whether a point came to its end.
bool is_complete(const nlohmann::ordered_json& result);
bool is_failed(const nlohmann::ordered_json& result);
// Its rows: "rows" of a program with several a point, else "row" alone.
std::vector<const nlohmann::ordered_json*> rows_of(const nlohmann::ordered_json& result);
// What the programs say of their runs, each sentence behind its point's name where there are
// several points.
std::vector<std::string> notes_of(const ExperimentFile& file, const Results& results);
// The numbers of all points, and of those without a result.
std::vector<std::size_t> all_points(const ExperimentFile& file);
std::vector<std::size_t> missing_points(const Results& results);

// A simulated fault, a defect, or no memory on the host; null for any other exception.
nlohmann::ordered_json make_failure(const std::exception& error);
// Of a process that came to nothing.
nlohmann::ordered_json make_failure(const std::string& died);
// Adds what the axes of a failed point need.
void add_axes(const Experiment& experiment, nlohmann::ordered_json& failure);

// Why a run of so many points ended: a sentence.
std::string describe_end(const Results& results, std::size_t points);
// Throws JobFailed if a point failed: with exit code 1 for a defect or a process that came to
// nothing, else 3. `where` says what has become of the results.
void throw_failures(const ExperimentFile& file, const Results& results, const std::string& where);

}  // namespace laboratory
