#pragma once
// tlab run: turns an experiment file into a folder of results.
#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

/// Treatment of points without records: simulate them, or throw an error.
enum class Missing { run, refuse };

/// Runs every missing point and evaluates the checks. Writes results.csv, run.json, checks.csv,
/// images, plots and report.html into the folder, either all of them or none. Only the records of
/// points are written earlier, each as soon as its point is done.
///
/// The results depend only on the experiment. They are independent of the number of jobs, and of
/// points kept from an earlier, partial or killed run. If some points fail, or a limit or the user
/// ends the run early, the results are kept and marked incomplete. Failed checks do not affect the
/// results.
///
/// Throws BadInput if the folder has results of another experiment, and for missing points under
/// Missing::refuse. Writes nothing if all points failed.
Simulation simulate(const RunOptions& options, const ExperimentFile& file, const CheckPlan& plan,
                    Missing missing = Missing::run);

/// Simulates the experiment and prints a summary. After writing everything, throws Failure if the
/// user interrupted, a point failed, or a check fails. A check that matches no point of this run is
/// mentioned, but does not fail.
void run_experiment(const RunOptions& options);

/// Prints the outcome of a check, on one line.
void print_verdict(const CheckResult& check, const Table& table);

/// Prints one line for each point, with fields separated by tabs: number, key, axes, and "there" or
/// "missing".
void list_points(const RunOptions& options);

/// Runs those of the chosen points that have no records. Writes only their records and the
/// description of their experiment, for merge_results. Several processes may do so at once. Throws
/// BadInput for unknown point numbers and for cost = "timed". Throws Failure if the user
/// interrupted or a point failed.
void run_chosen_points(const RunOptions& options);

/// Writes the files of run_experiment into a folder that holds the record of every point. Throws
/// BadInput with a list of missing records.
void merge_results(const std::string& folder);

}  // namespace laboratory
