#pragma once
// Description of a machine as JSON for live pages, in the format of docs/manual/live.md.
#include <deque>
#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/observe/control_panel.hpp"

namespace laboratory {

/// Describes what stays the same during a run: title, program, network, and positions of
/// processors.
nlohmann::ordered_json make_outline(const ExperimentFile& file, const machine::Machine& machine,
                                    const observe::ControlPanel& view);

/// Describes a processor: its memory, the quantities that the program shows for it, and its first
/// processes, each with the event that it waits for.
nlohmann::ordered_json describe_processor(const machine::Processor& processor,
                                          const observe::ControlPanel& view);

/// Lists the processors and processes that wait for each other in a cycle; empty if there is none.
nlohmann::ordered_json describe_deadlock(const machine::Machine& machine);

/// Loads of all processors and links in a recent interval of simulated time.
class RecentLoads {
 public:
  /// Sets the length of the interval, in simulated seconds, over which loads are averaged. Its
  /// start is rounded to a call of describe(). With 0, the interval begins at the previous call.
  void set_interval(double interval_s) { interval_s_ = interval_s; }

  /// Lists, in thousandths, the loads of every processor and link direction in the interval that
  /// ends at `now_s`. Also lists the lengths of the queues of ready processes, the links that
  /// transfer, the cut links and the stopped processors. All events before `now_s` must have
  /// happened. Returns the previous loads if no simulated time has passed.
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
