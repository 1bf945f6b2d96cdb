#pragma once
// tlab run: an experiment file in, a folder of results out.
#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

/// What to do about points that have no records.
enum class Missing { run, refuse };

/// Runs every point that is missing, evaluates the checks, and writes results.csv, run.json,
/// checks.csv, images, plots and report.html into the folder, all or nothing; only the records of
/// points are there as soon as they are done. The results depend on the experiment only: not on the
/// jobs, nor on which points were there from an earlier run, from run_chosen_points or from one
/// that was killed. A run that is cut short, by its limit or by the user, and one with failed
/// points are kept too, marked incomplete, unless all have failed; whether checks hold changes
/// nothing here. Throws BadInput for results of another experiment, and for what is missing if that
/// is refused.
Simulation simulate(const RunOptions& options, const ExperimentFile& file, const CheckPlan& plan,
                    Missing missing = Missing::run);

/// Simulates and prints a summary. Throws Failure, when everything is written, if the user
/// interrupted, if a point failed, and if a check does not hold; one that speaks of no point of
/// this run is only named.
void run_experiment(const RunOptions& options);

/// Prints what came of a check, a line.
void print_verdict(const CheckResult& check, const Table& table);

/// Prints a line for each point, with tabs: number, key, axes, "there" or "missing".
void list_points(const RunOptions& options);

/// Runs the chosen points that are missing and keeps their records in the folder, with a note of
/// the experiment that they are of, for merge_results; nothing else there is changed, and other
/// processes may do the same at once. Throws BadInput for numbers of no point, and where cost =
/// "timed"; Failure where the user interrupted and where a point failed.
void run_chosen_points(const RunOptions& options);

/// Writes what run_experiment does into a folder that has the records of every point of its
/// experiment. Throws BadInput with the missing ones.
void merge_results(const std::string& folder);

}  // namespace laboratory
