#include "experiments/laboratory/points/trace_files.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "base/errors.hpp"
#include "base/whole_file.hpp"

namespace laboratory {

namespace {

namespace fs = std::filesystem;
using Save = void (*)(const observe::Trace&, std::ostream&);

// Null for an unknown ending.
Save find_format(const std::string& file) {
  const auto ending = fs::path(file).extension();
  if (ending == ".json") return &observe::save_chrome;
  if (ending == ".paje" || ending == ".trace") return &observe::save_paje;
  return ending == ".svg" ? &observe::save_timeline : nullptr;
}

// What would go wrong after the simulation goes wrong before it.
void check_place(const char* option, const std::string& file, const fs::path& results) {
  const auto inside = fs::weakly_canonical(fs::absolute(file))
                          .lexically_relative(fs::weakly_canonical(fs::absolute(results)));
  if (!inside.empty() && *inside.begin() != "..")
    throw base::BadInput(
        fmt::format("{}: found {}, expected a file outside of the results folder {}, which is "
                    "replaced as a whole",
                    option, file, results.string()));
  base::check_can_save(file);
}

}  // namespace

void check_trace_files(const RunOptions& options, std::size_t points, const fs::path& results) {
  for (const auto& [option, file, endings] :
       {std::tuple("--trace", options.trace, ".json or .paje"),
        std::tuple("--timeline", options.timeline, ".svg")}) {
    if (file.empty()) continue;
    const bool is_chart = fs::path(file).extension() == ".svg";
    if (!find_format(file) || is_chart != (std::string_view(option) == "--timeline"))
      throw base::BadInput(
          fmt::format("{}: found {}, expected a name that ends in {}", option, file, endings));
    if (points > 1)
      throw base::BadInput(fmt::format(
          "{}: the experiment has {} points, expected one; choose it with --set, for example "
          "--set 'sweep.workers=[4]'",
          option, points));
    check_place(option, file, results);
  }
  if (!(options.from_s < options.until_s))
    throw base::BadInput(fmt::format("--from: found {}, expected a time before --until {}",
                                     options.from_s, options.until_s));
}

TraceFiles::TraceFiles(const RunOptions& options) : options_(options) {
  watch_.until = {options.until_s};
  watch_.from = {options.from_s};
  if (!options.trace.empty() || !options.timeline.empty()) watch_.trace = &trace_;
}

void TraceFiles::save(const std::string& title) {
  trace_.title = title;
  for (const auto& file : {options_.trace, options_.timeline})
    if (!file.empty())
      base::save_whole(file, [&](std::ostream& out) { find_format(file)(trace_, out); });
}

}  // namespace laboratory
