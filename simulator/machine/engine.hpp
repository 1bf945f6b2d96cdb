#pragma once
// The simulated clock, its events and the links.
//
// tlab schedules the processors itself, because SimGrid has no processor with two priorities.
// SimGrid only provides the clock and the transfers.
#include "simulator/machine/carriers/carrier.hpp"
#include "simulator/machine/units.hpp"

namespace machine {

/// Implementation of message transfer over links. Results differ only by rounding of dates.
enum class Links : std::uint8_t {
  simgrid,  ///< at most one machine during the life of a host process
  direct,   ///< several times faster, and much faster on large machines; processes are fibers
};

struct EngineParams {
  Links links = Links::simgrid;
  Processes processes = Processes::fibers;
  /// The part of each processor, in the order of add_processor(). Each part runs in its own host
  /// thread, see Parts. Parts are numbered from 0 without gaps, and processors without an entry are
  /// in part 0. An empty vector means one part. The division does not affect results. Several parts
  /// require Links::direct.
  std::vector<int> parts = {};
};

class Process;

/// The clock, events and links of a machine, or of one of its parts.
class Engine {
 public:
  using Callback = machine::Callback;
  using End = Events::End;

  /// Throws InvariantBroken for actors without SimGrid.
  Engine(MakeCarrier make, Processes processes);

  /// See Carrier.
  void add_processor(const std::string& name) { carrier_->add_processor(name); }
  std::size_t add_link(int a, int b, LinkRates rates, std::size_t rank) {
    return carrier_->add_link(a, b, rates, rank);
  }
  /// True if every process needs a stack, even a Proc, as with SimGrid's actors.
  bool needs_stacks() const { return needs_stacks_; }
  /// Makes the coroutine of a process. Callbacks resume it. After run() it is resumed only to
  /// unwind its stack.
  std::unique_ptr<Coroutine> make_coroutine(int processor, const std::string& name,
                                            Coroutine::Body body) {
    return carrier_->make_coroutine(processor, name, std::move(body));
  }

  Seconds now() const { return {events_.now()}; }
  Seconds until() const { return {events_.until()}; }  ///< limit given to run(); infinite before
  /// Schedules a callback at `date`, which must not be in the past. Callbacks never nest.
  void at(Seconds date, auto then) { events_.at(date.value, then); }
  /// Schedules a callback before all callbacks of at() with the same date.
  void first_at(Seconds date, auto then) { events_.first_at(date.value, then); }
  /// Schedules a callback between those of first_at() and at() with the same date, ordered by rank.
  void ranked_at(Seconds date, std::uint64_t rank, auto then) {
    events_.ranked_at(date.value, rank, then);
  }
  /// Schedules a callback after all others with the same date.
  void last_at(Seconds date, auto then) { events_.last_at(date.value, then); }
  /// Schedules a callback directly after the current event, at the same date.
  void soon(auto then) { events_.soon(then); }
  /// Moves `bytes` (> 0) in an idle direction of a link, then calls back.
  void transfer(std::size_t direction, std::uint64_t bytes, Callback arrived) {
    carrier_->start(direction, bytes, arrived);
  }
  /// See Carrier.
  double left_of(std::size_t direction, Seconds date) const {
    return carrier_->left_of(direction, date.value);
  }
  /// Cuts both directions of a link. Current messages never arrive, and no message may start
  /// afterwards.
  void cut(std::size_t direction) {
    carrier_->cut(direction);
    carrier_->cut(direction ^ 1);
  }

  /// Calls `pace` before the clock advances, see Pace. Throws InvariantBroken with SimGrid, whose
  /// clock cannot be delayed.
  void set_pace(Pace& pace);

  /// Runs until no event is left, the clock would pass `until`, or stop() or request_stop() is
  /// called. The clock stays at the last event or at `until`.
  End run(Seconds until);
  /// Marks the current event as one without effect, so that it does not extend the run.
  void ignore_event() { events_.ignore(); }
  /// After a run: sets the clock back to the last event that had an effect.
  void rewind() { events_.rewind_to(events_.last_useful()); }
  /// Drops all pending events and ends the run.
  void stop() { events_.stop(End::stopped); }
  std::uint64_t handled() const { return events_.handled(); }  ///< number of handled events
  /// Counter that grows with each event scheduled during the current event.
  std::uint64_t asked() const { return events_.asked(); }

  // --- for Parts and for links between two parts ----------------------------------------------
  /// Processes that are computing and will then reach such a link.
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
