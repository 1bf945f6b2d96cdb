#pragma once
// tlab verify: experiments against their formulas and references.
#include <string>
#include <vector>

namespace laboratory {

struct VerifyOptions {
  std::vector<std::string> paths;  // experiment files, or folders of them
  std::string output;              // of one file its folder of results; else the folder of those
  std::vector<std::string> overrides;
  unsigned jobs = 1;
  bool all = false;  // show every point of a check, and not only the worst of many
};

// Runs as `tlab run` does, points that are missing only, and prints every check with its points.
// Results go where `tlab run` puts them, those of DIR/A/B.toml to results/A/B. Throws ChecksFailed,
// after all has been printed, unless every check holds; one that speaks of no point does not.
void verify(const VerifyOptions& options);

}  // namespace laboratory
