#pragma once
// A machine: processors joined by links; it runs until every process has ended.
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "simulator/machine/link.hpp"
#include "simulator/machine/parts.hpp"

namespace machine {

/// Reason for the end of a run: every process has ended, its time was up, or the user interrupted.
enum class End {
  done,
  limit,
  interrupt,
  deadlock,  ///< only on a machine with failures, see observe::run
};
std::string_view to_string(End end);

/// A failure: the links between two processors are cut, or a processor stops.
struct Failure {
  Seconds at;
  Processor* a;
  Processor* b;  ///< at the links' other ends; null if `a` stops
};

class Machine {
 public:
  explicit Machine(const Model& model, Code code = Code::bare, EngineParams engine = {})
      : model_(std::make_shared<const Model>(model)), code_(code), parts_(std::move(engine)) {}

  /// `memory` in bytes; `role` as Processor::role(); null `model`: the machine's model.
  Processor& add_processor(std::string name, std::uint64_t memory, std::string role = {},
                           std::shared_ptr<const Model> model = {});
  /// Adds a second processor on the memory of `of`. Throws Misuse if `of` has a companion already.
  /// Each has its own CPU and links; soft channels may join their processes, see
  /// occam::ChannelBase. If one of the two stops, the other continues.
  Processor& add_companion(Processor& of, std::string name, std::string role = {});
  /// Joins two processors by a further link, through a number of C004 link switches. Throws Misuse
  /// beyond four links per processor, for a link to the same processor, and for different link
  /// speeds of the two models.
  void connect(Processor& a, Processor& b, int switches = 0);
  /// One direction of a link between the two processors: `number` counts their links from 0 in the
  /// order of connect(). Throws Misuse if there is none.
  LinkDirection& link(const Processor& from, const Processor& to, std::size_t number = 0);

  // The next four functions are only for a machine that runs in one part, see EngineParams.
  /// Cuts the links between two processors from the date `at` on, in both directions; a message
  /// under way is lost. For its channels see occam::ChannelBase. No effect if the date is after the
  /// end of the run, or if the link is cut already. `at` must not be before now.
  void cut_link(Processor& a, Processor& b, Seconds at);
  /// From the date on, no process of the processor runs, and all its links are cut. Its processes
  /// count neither as ended nor as blocked: the run is done when those of the other processors have
  /// ended.
  void stop_processor(Processor& processor, Seconds at);
  /// Calls back at every cut and stop, after the machine has changed and before all other events of
  /// that instant. (The links of a stopped processor are not reported one by one.)
  void on_failure(std::function<void(const Failure&)> observer);

  /// Reports the actions of processors and links to the observer from now on (only for a machine in
  /// one part); null: no reports. During a run, actions that began before are not reported.
  void set_observer(Observer* observer);

  /// Calls `pace` before the clock advances, see Pace; only with Links::direct, before run().
  void set_pace(Pace& pace) { parts_.only("a pace").set_pace(pace); }
  /// Ends the run at its next event, as if the user had interrupted it.
  void stop() { parts_.stop(); }

  /// Runs until no process can do anything, or up to a time limit. Rethrows a process's exception.
  /// Throws Deadlock, with the channels that processes wait on, if no event is left before or after
  /// the limit and some processes have not ended.
  End run(Seconds until = {std::numeric_limits<double>::infinity()});

  /// Only between runs if there are several parts; during a run ask a processor.
  Seconds now() const { return parts_.now(); }
  std::uint64_t events() const { return parts_.handled(); }
  Parts::Windows windows() const { return parts_.windows(); }
  const Model& model() const { return *model_; }
  const std::vector<std::unique_ptr<Processor>>& processors() const { return processors_; }
  const std::vector<std::unique_ptr<LinkDirection>>& links() const { return links_; }

 private:
  Processor& add(std::string name, std::shared_ptr<Memory> memory, std::string role,
                 std::shared_ptr<const Model> model, Engine& engine);
  Seconds lookahead() const;
  void throw_failure() const;
  void plan(const Failure& failure);
  void expect(const Failure& failure);
  void happen_now();
  bool happen(const Failure& failure);
  bool cut_both_ways(LinkDirection& link);
  bool cut_all(const Processor& a, const Processor& b);
  bool is_over() const;

  const std::shared_ptr<const Model> model_;
  Code code_;
  Parts parts_;
  std::vector<std::unique_ptr<Processor>> processors_;
  std::vector<std::unique_ptr<LinkDirection>> links_;
  std::vector<std::size_t> ports_;  // number in use, by processor
  std::map<std::pair<int, int>, std::vector<LinkDirection*>> links_of_;
  std::vector<Failure> planned_;                      // requested before the run
  std::map<Seconds, std::vector<Failure>> failures_;  // pending
  std::optional<Seconds> runs_until_;                 // set once the run has begun
  std::vector<std::function<void(const Failure&)>> failure_observers_;
};

/// Blocked processes that wait for each other in a cycle; the first is repeated at the end. Empty
/// if there is no cycle.
std::vector<const Process*> find_wait_cycle(const Machine& machine);

}  // namespace machine
