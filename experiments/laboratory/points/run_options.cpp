#include "experiments/laboratory/points/run_options.hpp"

#include <fmt/format.h>

#include <cmath>

namespace laboratory {

std::filesystem::path results_folder(const RunOptions& options) {
  if (!options.output.empty()) return options.output;
  return std::filesystem::path("results") / std::filesystem::path(options.file).stem();
}

std::string command_line(const RunOptions& options) {
  std::string line = "tlab run " + options.file;
  for (const auto& set : options.overrides) line += fmt::format(" --set '{}'", set);
  if (std::isfinite(options.until_s)) line += fmt::format(" --until {}", options.until_s);
  return line;
}

}  // namespace laboratory
