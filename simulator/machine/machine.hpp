#pragma once
// A machine of processors and links. It runs until every process has ended.
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "simulator/machine/link.hpp"
#include "simulator/machine/parts.hpp"

namespace machine {

/// Reason why a run ended: every process has ended (`done`), the time limit was reached (`limit`),
/// or the user interrupted it (`interrupt`).
enum class End {
  done,
  limit,
  interrupt,
  deadlock,  ///< only on a machine with failures, see observe::run
};
std::string_view to_string(End end);

/// A failure: either all links between two processors are cut, or a processor stops.
struct Failure {
  Seconds at;
  Processor* a;
  Processor* b;  ///< the processor at the other end of the links; null if processor `a` stops
};

class Machine {
 public:
  /// `parts` can be made from EngineParams.
  explicit Machine(const Model& model, Code code = Code::bare, Parts parts = {})
      : model_(std::make_shared<const Model>(model)), code_(code), parts_(std::move(parts)) {}

  /// Adds a processor with `memory` bytes. `role` is its purpose in the program and may be empty.
  /// If `model` is null, the processor has the machine's model.
  Processor& add_processor(std::string name, std::uint64_t memory, std::string role = {},
                           std::shared_ptr<const Model> model = {});
  /// Adds a companion: a second processor with its own CPU and links that shares the memory of
  /// `of`. Processes on the two processors can use soft channels (channels in memory, see
  /// occam::ChannelBase). If either processor stops, the other one continues. Throws Misuse if `of`
  /// already has a companion.
  Processor& add_companion(Processor& of, std::string name, std::string role = {});
  /// Adds a link between two processors. The link passes through `switches` C004 link switches.
  /// Throws Misuse if a processor would have more than four links or a link to itself, or if the
  /// models of the two processors have different link speeds.
  void connect(Processor& a, Processor& b, int switches = 0);
  /// The direction from `from` to `to` of a link. `number` selects one of several links between the
  /// two processors; it counts from 0 in the order of connect(). Throws Misuse if there is no such
  /// link.
  LinkDirection& link(const Processor& from, const Processor& to, std::size_t number = 0);

  // The next four functions require a machine in one part, see EngineParams.
  /// Cuts all links between two processors at date `at`, in both directions. Moving messages are
  /// lost. For the effect on channels see occam::ChannelBase. Has no effect after the end of the
  /// run or on links already cut. `at` must not be in the past.
  void cut_link(Processor& a, Processor& b, Seconds at);
  /// Stops a processor at date `at`: none of its processes runs afterwards, and all its links are
  /// cut. Its processes count neither as ended nor as blocked. The run is done when the processes
  /// of all other processors have ended.
  void stop_processor(Processor& processor, Seconds at);
  /// Registers a callback for every failure. It runs after the machine has changed and before all
  /// other events of that date. The links of a stopped processor are not reported individually.
  void on_failure(std::function<void(const Failure&)> observer);

  /// Sets the observer of all processors and links; null removes it. Requires a machine in one
  /// part. If set during a run, activities that have already begun are not reported.
  void set_observer(Observer* observer);

  /// Calls `pace` before the clock advances (see Pace). Must be called before run(), and requires
  /// Links::direct.
  void set_pace(Pace& pace) { parts_.only("a pace").set_pace(pace); }
  /// Ends the run at its next event, as if interrupted by the user.
  void stop() { parts_.stop(); }

  /// Runs until nothing can happen any more, or until the time limit. Rethrows an exception thrown
  /// by a process. Throws Deadlock if no event is left although some processes have not ended; the
  /// message names the channels where they wait.
  End run(Seconds until = {std::numeric_limits<double>::infinity()});

  /// Date of the clock. In a machine with several parts, valid only between runs; during a run use
  /// Processor::now().
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
  std::vector<std::size_t> ports_;  // number of used link ports, by processor
  std::map<std::pair<int, int>, std::vector<LinkDirection*>> links_of_;
  std::vector<Failure> planned_;                      // failures planned before the run
  std::map<Seconds, std::vector<Failure>> failures_;  // failures still to happen, by date
  std::optional<Seconds> runs_until_;                 // time limit of the run; empty before the run
  std::vector<std::function<void(const Failure&)>> failure_observers_;
};

/// Finds blocked processes that wait for each other in a cycle. The first one is repeated at the
/// end of the list. Returns an empty list if there is no cycle.
std::vector<const Process*> find_wait_cycle(const Machine& machine);

}  // namespace machine
