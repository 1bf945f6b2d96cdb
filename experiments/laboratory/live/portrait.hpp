#pragma once
// A machine as pages are told of it. JSON as docs/manual/live.md lists it.
#include <deque>
#include <nlohmann/json.hpp>
#include <vector>

#include "experiments/laboratory/file/experiment.hpp"
#include "simulator/observe/spectator.hpp"

namespace laboratory {

/// What does not change during a run.
nlohmann::ordered_json make_outline(const ExperimentFile& file, const machine::Machine& machine,
                                    const observe::View& view);

/// A processor's memory, what the program knows of it, and its first processes with what each waits
/// for.
nlohmann::ordered_json describe_processor(const machine::Processor& processor,
                                          const observe::View& view);

/// The processors and the processes of a cycle of waits; none if there is no cycle.
nlohmann::ordered_json describe_deadlock(const machine::Machine& machine);

/// How busy everything was lately.
class RecentLoads {
 public:
  /// Loads are of the last so many simulated seconds, or a little more; 0: since the last call.
  void set_interval(double interval_s) { interval_s_ = interval_s; }

  /// Loads, in thousandths, of every processor and direction of a link up to `now_s`, before which
  /// nothing more happens; queues, and what moves, is cut, or has stopped. Where no time has
  /// passed, the loads are those told last.
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
