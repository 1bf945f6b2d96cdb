#pragma once
// tlab run: an experiment file in, a folder of results out.
#include "experiments/laboratory/points/run_options.hpp"

namespace laboratory {

// Runs every point that is missing, then writes results.csv, run.json, checks.csv, images, plots
// and report.html into the folder, all or nothing, and prints a summary. The results depend on the
// experiment only: not on the jobs, nor on which points were there from an earlier run, from
// run_points_of or from one that was killed. A run that is cut short, by its limit or by the user,
// and one with failed points are kept too, marked incomplete.
// Throws CutShort, when everything is written, if the user interrupted; JobFailed, when everything
// is written, if a point failed, and before if all have; ChecksFailed, when everything is written,
// if a check does not hold; one that speaks of no point of this run is only named.
void run_experiment(const RunOptions& options);

// Prints a line for each point, with tabs: number, key, axes, "there" or "missing".
void list_points(const RunOptions& options);

// Runs the chosen points that are missing and keeps their records in the folder, with a note of the
// experiment that they are of, for merge_results; nothing else there is changed, and other
// processes may do the same at once. Throws base::BadInput for
// numbers of no point, and where cost = "timed"; CutShort and JobFailed as run_experiment.
void run_chosen_points(const RunOptions& options);

// Writes what run_experiment does into a folder that has the records of every point of its
// experiment. Throws base::BadInput with the missing ones.
void merge_results(const std::string& folder);

}  // namespace laboratory
