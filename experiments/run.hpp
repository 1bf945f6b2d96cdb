#pragma once
// tlab run: an experiment file in, a folder of results out.
#include <limits>
#include <string>
#include <vector>

namespace experiments {

struct RunOptions {
  std::string file;                    // the experiment
  std::string output;                  // results folder; "": results/NAME
  std::vector<std::string> overrides;  // --set
  unsigned jobs = 1;                   // points run side by side
  bool profile = false;
  double until_s = std::numeric_limits<double>::infinity();  // simulated
  double from_s = 0;                                         // simulated; of trace and timeline
  std::string trace;     // file for the one point's trace: .json (Perfetto) or .paje
  std::string timeline;  // file for its time line: .svg
};

// Runs every point, then writes results.csv, run.json, checks.csv, images, plots and report.html
// into the folder, all or nothing, and prints a summary. The results depend on the experiment only.
// A run that is cut short, by its limit or by the user, is kept too, marked incomplete.
// Throws CutShort, when everything is written, if the user interrupted; ChecksFailed, when
// everything is written, if a check does not hold; one that speaks of no point of this run is only
// named.
void run_experiment(const RunOptions& options);

}  // namespace experiments
