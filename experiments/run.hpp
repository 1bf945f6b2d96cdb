#pragma once
// tlab run: an experiment file in, a folder of results out.
#include <string>
#include <vector>

namespace experiments {

struct RunOptions {
  std::string file;                    // the experiment
  std::string output;                  // results folder; "": results/NAME
  std::vector<std::string> overrides;  // --set
  unsigned jobs = 1;                   // points run side by side
  bool profile = false;
};

// Runs every point, then writes results.csv, run.json, images, plots and report.html into the
// folder, all or nothing, and prints a summary. The results depend on the experiment only.
void run_experiment(const RunOptions& options);

}  // namespace experiments
