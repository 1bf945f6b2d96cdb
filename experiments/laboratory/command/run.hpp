#pragma once
// tlab run: turns an experiment file into a folder of results.
#include "experiments/laboratory/judge/check_plan.hpp"
#include "experiments/laboratory/report/simulation.hpp"

namespace laboratory {

/// What to do with points of the sweep that have no stored results: simulate them, or throw an
/// error.
enum class Missing { run, refuse };

/// Simulates every point without a record (the stored result of one point), and evaluates the
/// checks. Writes results.csv, run.json, checks.csv, images, plots and report.html into the folder,
/// either all of them or none. Only records are written earlier, each as soon as the simulation of
/// its point has ended.
///
/// The results depend only on the experiment. They do not depend on the number of jobs, or on the
/// points whose records were kept from an earlier, partial or killed run. If some points fail, or a
/// time limit or the user ends the run early, the results are kept and marked incomplete. Failed
/// checks do not affect the results.
///
/// Throws BadInput if the folder holds results of another experiment, and for points without
/// records under Missing::refuse. Writes nothing if all points failed.
Simulation simulate(const RunOptions& options, const ExperimentFile& file, const CheckPlan& plan,
                    Missing missing = Missing::run);

/// Simulates the experiment and prints a summary. Writes all results first, and then throws Failure
/// if the user interrupted, a point failed, or a check fails. Mentions checks that match no point
/// of this run, but does not count them as failed.
void run_experiment(const RunOptions& options);

/// Prints the outcome of a check, on one line.
void print_verdict(const CheckResult& check, const Table& table);

/// Prints one line for each point, with fields separated by tabs: number, key, values of the axes,
/// and "there" if the point has a record or "missing" if not.
void list_points(const RunOptions& options);

/// Simulates the points chosen with --point that have no records. Writes only their records and the
/// description of their experiment, which merge_results() needs. Several processes may do this for
/// one folder at the same time. Throws BadInput for unknown point numbers and for cost = "timed".
/// Throws Failure if the user interrupted or a point failed.
void run_chosen_points(const RunOptions& options);

/// Writes the files of run_experiment() into a folder that already holds the record of every point.
/// If the folder lacks records, throws BadInput with a list of them.
void merge_results(const std::string& folder);

}  // namespace laboratory
