#pragma once
// tlab verify: experiments against their formulas and references.
#include <string>
#include <vector>

namespace laboratory {

struct VerifyOptions {
  std::vector<std::string> paths;  ///< experiment files, or folders of them
  std::string output;              ///< folder of results for one file, else the folder of those
  std::vector<std::string> overrides;
  unsigned jobs = 1;
  bool all = false;  ///< show every point of a check, and not only the worst of many
};

/// Runs as `tlab run` does, points that are missing only, and prints every check with its points.
/// Results go where `tlab run` puts them, those of DIR/A/B.toml to results/A/B. After all has been
/// printed it throws ChecksFailed unless every check holds and every path has one; a check that
/// speaks of no point does not hold.
void verify(const VerifyOptions& options);

}  // namespace laboratory
