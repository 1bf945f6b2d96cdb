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
  /// Sets the simulated time in s over which loads are averaged. The time is rounded up to the next
  /// sample. With 0, loads are averaged since the last call of update().
  void set_interval(double interval_s) { interval_s_ = interval_s; }

  /// Takes the loads of all processors and link directions up to `now_s`. No event before `now_s`
  /// may follow. Keeps the previous loads if no time has passed.
  void update(const machine::Machine& machine, double now_s);
  /// The mean load of the processors, and the largest load of a link direction (NaN without links),
  /// from 0 to 1.
  double mean_cpu() const;
  double max_link() const;
  /// Lists the loads taken by update(), in thousandths. Also lists queue lengths, links that
  /// transfer, cut links and stopped processors at `now_s`.
  nlohmann::ordered_json describe(const machine::Machine& machine, double now_s) const;

 private:
  struct Busy {
    double at_s;
    std::vector<double> cpus_s, links_s;
  };
  double interval_s_ = 0;
  std::deque<Busy> busy_;
  // shares taken by the last update(), and the time over which they are averaged
  double time_s_ = 0;
  std::vector<double> cpus_, links_;
};

}  // namespace laboratory
