#pragma once
// The files that show what a point's processors and links did: --trace and --timeline.
#include <filesystem>

#include "experiments/laboratory/points/run_options.hpp"
#include "simulator/observe/watch.hpp"

namespace laboratory {

// Throws base::BadInput for a name whose ending says no format, a place inside of the
// results folder, or more than one point; std::system_error where no file can be written.
void check_trace_files(const RunOptions& options, std::size_t points,
                       const std::filesystem::path& results);

// Watches one point as the options say: its limit, and its trace if any file is wanted.
class TraceFiles {
 public:
  explicit TraceFiles(const RunOptions& options);
  observe::Watch& watch() { return watch_; }
  // Writes the files, each whole or not at all.
  void save(const std::string& title);

 private:
  const RunOptions& options_;
  observe::Trace trace_;
  observe::Watch watch_;
};

}  // namespace laboratory
