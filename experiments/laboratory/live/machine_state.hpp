#pragma once
// Description of a machine as JSON for live pages, in the format of docs/manual/live.md.
#include <deque>
#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/observe/control_panel.hpp"

namespace laboratory {

/// Describes the constant part of a run.
nlohmann::ordered_json make_outline(const ExperimentFile& file, const machine::Machine& machine,
                                    const observe::ControlPanel& view);

/// Describes a processor: its memory, the gauges that the program shows for it, and its first
/// processes with what each waits for.
nlohmann::ordered_json describe_processor(const machine::Processor& processor,
                                          const observe::ControlPanel& view);

/// Lists the processors and processes of a cycle of waits; empty if there is no cycle.
nlohmann::ordered_json describe_deadlock(const machine::Machine& machine);

/// Recent loads of all processors and links.
class RecentLoads {
 public:
  /// Sets the simulated time in s over which loads are averaged, rounded up to the next sample; 0:
  /// since the last call of describe().
  void set_interval(double interval_s) { interval_s_ = interval_s; }

  /// Lists the loads of every processor and link direction up to `now_s`, in thousandths. Also
  /// lists queue lengths, links that transfer, cut links and stopped processors. No event before
  /// `now_s` may follow. Repeats the previous loads if no time has passed.
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
