#include "experiments/trace_files.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <system_error>

#include "simulator/machine/faults.hpp"

namespace experiments {

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

// Beside its name, and renamed when it is whole.
void save_file(const std::string& file, const observe::Trace& trace) {
  const std::string partial = file + ".partial";
  std::ofstream out(partial, std::ios::binary);
  find_format(file)(trace, out);
  out.close();
  std::error_code error;
  if (out) fs::rename(partial, file, error);
  if (out && !error) return;
  std::error_code ignored;
  fs::remove(partial, ignored);
  throw std::system_error(error ? error : std::make_error_code(std::errc::io_error),
                          file + ": cannot be written");
}

}  // namespace

void check_trace_files(const RunOptions& options, std::size_t points) {
  for (const auto& [option, file, endings] :
       {std::tuple("--trace", options.trace, ".json or .paje"),
        std::tuple("--timeline", options.timeline, ".svg")}) {
    if (file.empty()) continue;
    const bool is_chart = fs::path(file).extension() == ".svg";
    if (!find_format(file) || is_chart != (std::string_view(option) == "--timeline"))
      throw machine::InvalidInput(
          fmt::format("{}: found {}, expected a name that ends in {}", option, file, endings));
    if (points > 1)
      throw machine::InvalidInput(fmt::format(
          "{}: the experiment has {} points, expected one; choose it with --set, for example "
          "--set 'sweep.workers=[4]'",
          option, points));
  }
}

TraceFiles::TraceFiles(const RunOptions& options) : options_(options) {
  watch_.until = {options.until_s};
  watch_.from = {options.from_s};
  if (!options.trace.empty() || !options.timeline.empty()) watch_.trace = &trace_;
}

void TraceFiles::save(const std::string& title) {
  trace_.title = title;
  for (const auto& file : {options_.trace, options_.timeline})
    if (!file.empty()) save_file(file, trace_);
}

}  // namespace experiments
