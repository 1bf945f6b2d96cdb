#pragma once
// A machine of processors and links, which runs until every process has ended.
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "simulator/machine/link.hpp"
#include "simulator/machine/parts.hpp"

namespace machine {

/// Reason for the end of a run: `done` if every process has ended, `limit` at the time limit,
/// `interrupt` on the user's request.
enum class End {
  done,
  limit,
  interrupt,
  deadlock,  ///< possible only on a machine with failures, see observe::run
};
std::string_view to_string(End end);

/// A failure: all links between two processors are cut, or a processor stops.
struct Failure {
  Seconds at;
  Processor* a;
  Processor* b;  ///< the processor at the other ends of the links; null if `a` stops
};

class Machine {
 public:
  /// `parts` is made from EngineParams.
  explicit Machine(const Model& model, Code code = Code::bare, Parts parts = {})
      : model_(std::make_shared<const Model>(model)), code_(code), parts_(std::move(parts)) {}

  /// Adds a processor. `memory` is in bytes, `role` as in Processor::role(). A null `model` stands
  /// for the machine's model.
  Processor& add_processor(std::string name, std::uint64_t memory, std::string role = {},
                           std::shared_ptr<const Model> model = {});
  /// Adds a companion: a second processor that shares the memory of `of` but has its own CPU and
  /// links. Soft channels may join their processes, see occam::ChannelBase. If either processor
  /// stops, the other one continues. Throws Misuse if `of` already has a companion.
  Processor& add_companion(Processor& of, std::string name, std::string role = {});
  /// Adds a link between two processors that passes `switches` C004 link switches. Throws Misuse if
  /// a processor would have more than four links or a link to itself, or if the link speeds of the
  /// models differ.
  void connect(Processor& a, Processor& b, int switches = 0);
  /// One direction of a link from `from` to `to`. `number` counts the links between the two from 0
  /// in the order of connect(). Throws Misuse if there is no such link.
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

  /// Sets the observer of processors and links; null removes it. Only for a machine in one part. If
  /// set during a run, activities that have already begun are not reported.
  void set_observer(Observer* observer);

  /// Calls `pace` before the clock advances, see Pace. Must be called before run(), only with
  /// Links::direct.
  void set_pace(Pace& pace) { parts_.only("a pace").set_pace(pace); }
  /// Ends the run at its next event, as if interrupted by the user.
  void stop() { parts_.stop(); }

  /// Runs until nothing can happen any longer, or until the time limit. Rethrows an exception of a
  /// process. Throws Deadlock, with the channels on which processes wait, if no event is left and
  /// some processes have not ended.
  End run(Seconds until = {std::numeric_limits<double>::infinity()});

  /// With several parts, valid only between runs; use Processor::now() during a run.
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
  std::vector<std::size_t> ports_;  // number of used ports, by processor
  std::map<std::pair<int, int>, std::vector<LinkDirection*>> links_of_;
  std::vector<Failure> planned_;                      // failures requested before the run
  std::map<Seconds, std::vector<Failure>> failures_;  // failures still to come, by date
  std::optional<Seconds> runs_until_;                 // empty before the run
  std::vector<std::function<void(const Failure&)>> failure_observers_;
};

/// Finds blocked processes that wait for each other in a cycle; the first is repeated at the end.
/// Returns an empty list if there is no cycle.
std::vector<const Process*> find_wait_cycle(const Machine& machine);

}  // namespace machine
