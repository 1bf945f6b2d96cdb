#pragma once
// The simulated clock, its events, and the links.
//
// Our own scheduler arbitrates processor time, because SimGrid has no two-priority processor. It
// needs only a clock and timed events.
#include "simulator/machine/carriers/carrier.hpp"
#include "simulator/machine/units.hpp"

namespace machine {

/// Implementation of message transfer over links. Results differ only by the rounding of dates.
enum class Links : std::uint8_t {
  simgrid,  ///< only one machine in the life of a host process
  direct,   ///< several times faster, many times on large machines; processes are fibers
};

struct EngineParams {
  Links links = Links::simgrid;
  Processes processes = Processes::fibers;
  /// Part of each processor, in the order of their addition; one host thread runs each part, see
  /// Parts. Numbers from 0 without gaps; further processors are in part 0. Empty: one part. Results
  /// do not depend on it. Only with Links::direct.
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
  /// True if every process needs a stack, even a Proc: with SimGrid's actors.
  bool needs_stacks() const { return needs_stacks_; }
  /// Body of a process. Callbacks resume it; after run() it is resumed only to unwind it.
  std::unique_ptr<Coroutine> make_coroutine(int processor, const std::string& name,
                                            Coroutine::Body body) {
    return carrier_->make_coroutine(processor, name, std::move(body));
  }

  Seconds now() const { return {events_.now()}; }
  Seconds until() const { return {events_.until()}; }  ///< limit given to run(); none before it
  /// Calls back at simulated time `date` (not before now). Callbacks never nest.
  void at(Seconds date, auto then) { events_.at(date.value, then); }
  /// The same, before all callbacks of at() at that instant.
  void first_at(Seconds date, auto then) { events_.first_at(date.value, then); }
  /// The same, after those of first_at() and before those of at(), in the order of ranks.
  void ranked_at(Seconds date, std::uint64_t rank, auto then) {
    events_.ranked_at(date.value, rank, then);
  }
  /// The same, after all others at that instant.
  void last_at(Seconds date, auto then) { events_.last_at(date.value, then); }
  /// Calls back after the current event, at the same simulated instant.
  void soon(auto then) { events_.soon(then); }
  /// Moves `bytes` (> 0) in a direction of a link, then calls back. One message at a time.
  void transfer(std::size_t direction, std::uint64_t bytes, Callback arrived) {
    carrier_->start(direction, bytes, arrived);
  }
  /// See Carrier.
  double left_of(std::size_t direction, Seconds date) const {
    return carrier_->left_of(direction, date.value);
  }
  /// Cuts both directions of a link. Messages under way never arrive, and no new ones may start.
  void cut(std::size_t direction) {
    carrier_->cut(direction);
    carrier_->cut(direction ^ 1);
  }

  /// Calls `pace` before the clock advances, see Pace. Throws InvariantBroken for SimGrid's engine,
  /// which cannot delay its clock.
  void set_pace(Pace& pace);

  /// Runs until no event is left, until the clock would pass `until`, or until stop() or
  /// request_stop(). The clock stays at the last event, or at `until`.
  End run(Seconds until);
  /// Called by an event that has no effect: it does not extend the run.
  void ignore_event() { events_.ignore(); }
  /// After a run: sets the clock back to the last event that was not ignored.
  void rewind() { events_.rewind_to(events_.last_useful()); }
  /// Drops all pending events.
  void stop() { events_.stop(End::stopped); }
  std::uint64_t handled() const { return events_.handled(); }  ///< number of events
  /// Counter that grows with each event scheduled during the current event.
  std::uint64_t asked() const { return events_.asked(); }

  // --- for Parts, and links between two of them -----------------------------------------------
  /// Processes that compute before they reach such a link.
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
