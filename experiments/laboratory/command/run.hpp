#pragma once
// tlab run: turns an experiment file into a folder of results.
#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

/// Treatment of points without records.
enum class Missing { run, refuse };

/// Runs every missing point, evaluates the checks, and writes results.csv, run.json, checks.csv,
/// images, plots and report.html into the folder, all or nothing. Only the records of points appear
/// as soon as each point is done. The results depend only on the experiment: not on the number of
/// jobs, nor on points kept from an earlier, partial or killed run. Runs with failed points, and
/// runs cut short by a limit or the user, are kept and marked incomplete unless all points failed.
/// The outcome of checks has no effect here. Throws BadInput for results of another experiment, and
/// for missing points under Missing::refuse.
Simulation simulate(const RunOptions& options, const ExperimentFile& file, const CheckPlan& plan,
                    Missing missing = Missing::run);

/// Simulates and prints a summary. After writing everything, throws Failure if the user
/// interrupted, a point failed, or a check fails. A check that matches no point of this run is only
/// named.
void run_experiment(const RunOptions& options);

/// Prints the outcome of a check, on one line.
void print_verdict(const CheckResult& check, const Table& table);

/// Prints a line for each point, separated by tabs: number, key, axes, "there" or "missing".
void list_points(const RunOptions& options);

/// Runs the chosen points that are missing. Keeps their records and a note of their experiment in
/// the folder for merge_results, and changes nothing else there. Several processes may do so at
/// once. Throws BadInput for unknown point numbers and for cost = "timed"; Failure if the user
/// interrupted or a point failed.
void run_chosen_points(const RunOptions& options);

/// Writes the files of run_experiment into a folder that holds the record of every point. Throws
/// BadInput that lists missing records.
void merge_results(const std::string& folder);

}  // namespace laboratory
