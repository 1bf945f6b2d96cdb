#pragma once
// A machine as JSON for pages, in the format of docs/manual/live.md.
#include <deque>
#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/observe/control_panel.hpp"

namespace laboratory {

/// The constant part of a run.
nlohmann::ordered_json make_outline(const ExperimentFile& file, const machine::Machine& machine,
                                    const observe::ControlPanel& view);

/// A processor's memory, the program's readings of it, and its first processes with the reason of
/// each wait.
nlohmann::ordered_json describe_processor(const machine::Processor& processor,
                                          const observe::ControlPanel& view);

/// The processors and processes of a cycle of waits; empty if there is no cycle.
nlohmann::ordered_json describe_deadlock(const machine::Machine& machine);

/// Recent loads of all processors and links.
class RecentLoads {
 public:
  /// Averages loads over this simulated time in s, or slightly more; 0: since the last call.
  void set_interval(double interval_s) { interval_s_ = interval_s; }

  /// Loads in thousandths, of every processor and link direction, up to `now_s`; no earlier event
  /// may follow. Also queues, and links and processors that are moving, cut or stopped. Repeats the
  /// previous loads if no time has passed.
  nlohmann::ordered_json describe(const machine::Machine& machine, double now_s);

 private:
  struct Busy {
    double at_s;
    std::vector<double> cpus_s, links_s;
  };
  double interval_s_ = 0;
  std::deque<Busy> busy_;
  nlohmann::ordered_json loads_;
};

}  // namespace laboratory
