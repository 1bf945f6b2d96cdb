#pragma once
// A machine: processors joined by links, run until every process has ended.
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "simulator/machine/link.hpp"
#include "simulator/machine/parts.hpp"

namespace machine {

/// Why a run ended: every process did, its time was up, or the user interrupted it.
enum class End {
  done,
  limit,
  interrupt,
  deadlock,  ///< of a machine in which something is broken: see observe::run
};
std::string_view to_string(End end);

/// The links between two processors were cut, or a processor stopped.
struct Failure {
  Seconds at;
  Processor* a;
  Processor* b;  ///< at the links' other ends; null if `a` stopped
};

class Machine {
 public:
  explicit Machine(const Model& model, Code code = Code::bare, EngineParams engine = {})
      : model_(std::make_shared<const Model>(model)), code_(code), parts_(std::move(engine)) {}

  /// `memory` in bytes; `role` as Processor::role(); null: the machine's model.
  Processor& add_processor(std::string name, std::uint64_t memory, std::string role = {},
                           std::shared_ptr<const Model> model = {});
  /// A second processor on the memory of one that has no companion yet, else Misuse. Each has its
  /// own CPU and links; soft channels may join their processes, see occam::ChannelBase. If one of
  /// them stops, the other goes on.
  Processor& add_companion(Processor& of, std::string name, std::string role = {});
  /// Joins two processors by a link, or one more, through a number of C004 link switches. Throws
  /// Misuse beyond four links a processor, for a processor and itself, and for two whose models'
  /// links run at different speeds.
  void connect(Processor& a, Processor& b, int switches = 0);
  /// A direction of the first link that joins them, or of a later one: `number` counts from 0 in
  /// the order of connect(). Throws Misuse if there is none.
  LinkDirection& link(const Processor& from, const Processor& to, std::size_t number = 0);

  // These four are only for a machine that runs in one part, see EngineParams.
  /// From the date on the links between the two carry nothing, in either direction: a message under
  /// way is lost. For its channels see occam::ChannelBase. Nothing happens if the date is after the
  /// end of the run, or the link is cut already. The date must not be over.
  void cut_link(Processor& a, Processor& b, Seconds at);
  /// From the date on none of its processes runs, and all its links are cut. The processes count
  /// neither as ended nor as blocked: the run is done when those of the other processors have
  /// ended.
  void stop_processor(Processor& processor, Seconds at);
  /// Calls back at every cut and stop, once the machine is so and before anything else happens at
  /// that instant. (The links of a processor that stops are not told one by one.)
  void on_failure(std::function<void(const Failure&)> observer);

  /// From now on the observer is told what processors and links do (of a machine in one part);
  /// null: nobody is. During a run it is told of nothing that has begun before.
  void set_observer(Observer* observer);

  /// Asks before the clock goes on, see Pace; only with Links::direct. To be called before run().
  void set_pace(Pace& pace) { parts_.only("a pace").set_pace(pace); }
  /// Ends the run at its next event, as if the user had interrupted it.
  void stop() { parts_.stop(); }

  /// Runs until no process can do anything, or up to a time limit. Throws what a process threw;
  /// Deadlock, with the channels that processes wait on, if some have not ended and nothing is left
  /// that could happen, before the limit or after it.
  End run(Seconds until = {std::numeric_limits<double>::infinity()});

  /// While it runs in several parts ask a processor.
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
  std::vector<std::size_t> ports_;  // in use, by processor
  std::map<std::pair<int, int>, std::vector<LinkDirection*>> links_of_;
  std::vector<Failure> planned_;                      // before the run
  std::map<Seconds, std::vector<Failure>> failures_;  // still to come
  std::optional<Seconds> runs_until_;                 // once the run has begun
  std::vector<std::function<void(const Failure&)>> failure_observers_;
};

/// Blocked processes that wait for each other in a cycle, the first again at the end; empty if none
/// do.
std::vector<const Process*> find_wait_cycle(const Machine& machine);

}  // namespace machine
