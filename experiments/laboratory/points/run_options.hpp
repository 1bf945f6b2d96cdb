#pragma once
// The options of tlab run.
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace laboratory {

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
  bool list = false;
  std::vector<std::string> points;  // --point: "3" or "3-5", numbers from 0
};

// Where results go: as asked, or results/NAME.
std::filesystem::path results_folder(const RunOptions& options);

// "tlab run FILE --set ..."
std::string command_line(const RunOptions& options);

}  // namespace laboratory
