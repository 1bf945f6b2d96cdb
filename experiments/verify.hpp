#pragma once
// tlab verify: experiments against their formulas and references.
#include <string>
#include <vector>

namespace experiments {

struct VerifyOptions {
  std::vector<std::string> paths;  // experiment files, or folders of them
  std::string output;              // of one file its folder of results; else the folder of those
  std::vector<std::string> overrides;
  unsigned jobs = 1;
  bool all = false;  // show every point of a check, and not only the worst of many
};

// Runs what has no results yet, and prints every check with its points. Results go where `tlab run`
// puts them, those of DIR/A/B.toml to results/A/B; they are used again if they are of the same
// experiment, program, models and files. Throws ChecksFailed, after all has been printed, unless
// every check holds; one that speaks of no point does not.
void verify(const VerifyOptions& options);

}  // namespace experiments
