#pragma once
// The simulated clock, its events, and the wires.
//
// Processor time is arbitrated by our own scheduler (SimGrid has no two-priority processor), which
// needs only a clock and events at a date.
#include "simulator/machine/carriers/carrier.hpp"
#include "simulator/machine/units.hpp"

namespace machine {

/// What moves the messages over the links. Results differ by no more than dates are rounded.
enum class Links : std::uint8_t {
  simgrid,  ///< one machine in the life of a host process
  direct,   ///< several times faster, on large machines many times; processes are fibers
};

struct EngineParams {
  Links links = Links::simgrid;
  Processes processes = Processes::fibers;
  /// The part of each processor, in the order they are added, where they are run by several threads
  /// of the host: numbers from 0 without gaps, see Parts. Others are in part 0. Results do not
  /// depend on it. Empty: one part. Only with Links::direct.
  std::vector<int> parts = {};
};

class Process;

/// The clock, events and links of a machine, or of a part of one.
class Engine {
 public:
  using Callback = machine::Callback;
  using End = Events::End;

  /// Throws InvariantBroken for actors without SimGrid.
  explicit Engine(EngineParams params = {});

  /// See Carrier.
  void add_processor(const std::string& name) { carrier_->add_processor(name); }
  std::size_t add_link(int a, int b, LinkRates rates, std::size_t rank) {
    return carrier_->add_link(a, b, rates, rank);
  }
  /// Whether every process needs a stack, a Proc too: SimGrid's actors have one.
  bool needs_stacks() const { return needs_stacks_; }
  /// A process's body, to be resumed by callbacks and, once it is to end, after run().
  std::unique_ptr<Coroutine> make_coroutine(int processor, const std::string& name,
                                            Coroutine::Body body) {
    return carrier_->make_coroutine(processor, name, std::move(body));
  }

  Seconds now() const { return {events_.now()}; }
  Seconds until() const { return {events_.until()}; }  ///< the limit given to run(); at first none
  /// Calls back at simulated time `date` (not before now). Callbacks never nest.
  void at(Seconds date, auto then) { events_.at(date.value, then); }
  /// The same, before all that at() has asked for at that instant.
  void first_at(Seconds date, auto then) { events_.first_at(date.value, then); }
  /// The same after them, but before others, in the order of ranks.
  void ranked_at(Seconds date, std::uint64_t rank, auto then) {
    events_.ranked_at(date.value, rank, then);
  }
  /// The same, after all others.
  void last_at(Seconds date, auto then) { events_.last_at(date.value, then); }
  /// Calls back when the event being handled is over, at the same simulated instant.
  void soon(auto then) { events_.soon(then); }
  /// Moves `bytes` (> 0) in a direction of a link, then calls back. One message at a time.
  void transfer(std::size_t direction, std::uint64_t bytes, Callback arrived) {
    carrier_->start(direction, bytes, arrived);
  }
  /// See Carrier.
  double left_of(std::size_t direction, Seconds date) const {
    return carrier_->left_of(direction, date.value);
  }
  /// What moves over the direction's link, in both directions, never arrives. Nothing may move
  /// there any more.
  void cut(std::size_t direction) {
    carrier_->cut(direction);
    carrier_->cut(direction ^ 1);
  }

  /// Asks before the clock goes on, see Pace. Throws InvariantBroken for SimGrid's engine, whose
  /// clock does not wait.
  void set_pace(Pace& pace);

  /// Runs until no event is left, until the clock would pass `until`, or until stop() or
  /// request_stop(). The clock stays at the last event, or at `until`.
  End run(Seconds until);
  /// Called by an event that turns out to be of no use any more: the clock does not stay at it when
  /// the run ends.
  void ignore_event() { events_.ignore(); }
  /// After a run: the clock goes back to the last event that was of use.
  void rewind() { events_.rewind_to(events_.last_useful()); }
  /// Drops all events still to come.
  void stop() { events_.stop(End::stopped); }
  std::uint64_t handled() const { return events_.handled(); }  ///< events
  /// Grows with every event that is asked for, while one is handled.
  std::uint64_t asked() const { return events_.asked(); }

  // --- for Parts, and links between two of them -----------------------------------------------
  /// Processes that compute before they come to such a link.
  std::vector<const Process*>& coming() { return coming_; }
  Events& events() { return events_; }
  Moment next() { return carrier_->next(); }
  void run_before(const Moment& bound) { carrier_->run_before(bound); }

 private:
  Events events_;
  bool can_wait_, needs_stacks_;
  std::unique_ptr<Carrier> carrier_;
  std::vector<const Process*> coming_;
};

}  // namespace machine
