#pragma once
// The simulated clock, its events and the links.
//
// tlab schedules the processes of a processor itself, because SimGrid has no processor with two
// priorities. SimGrid provides only the clock and the transfers over links.
#include "simulator/machine/carriers/carrier.hpp"
#include "simulator/machine/units.hpp"

namespace machine {

/// How messages are moved over links. Results differ only by rounding of dates.
enum class Links : std::uint8_t {
  simgrid,  ///< SimGrid; allows one machine in the life of a host process
  /// The carrier without SimGrid; faster, most of all on large machines. Processes are fibers.
  direct,
};

struct EngineParams {
  Links links = Links::simgrid;
  Processes processes = Processes::fibers;
  /// The number of each processor's part, in the order of add_processor(). Each part runs in its
  /// own host thread (see class Parts). Parts are numbered from 0 without gaps; processors without
  /// an entry are in part 0. An empty vector means one part. The division does not affect results.
  /// Several parts require Links::direct.
  std::vector<int> parts = {};
};

class Process;

/// The clock, events and links of a machine, or of one part of a machine.
class Engine {
 public:
  using Callback = machine::Callback;
  using End = Events::End;

  /// Throws InvariantBroken if `processes` is Processes::actors and `make` makes no SimGrid
  /// carrier.
  Engine(MakeCarrier make, Processes processes);

  /// The next two functions do what the functions with these names in Carrier do.
  void add_processor(const std::string& name) { carrier_->add_processor(name); }
  std::size_t add_link(int a, int b, LinkRates rates, std::size_t rank) {
    return carrier_->add_link(a, b, rates, rank);
  }
  /// True if every process needs a stack, even if its body is a Proc (a coroutine without a stack).
  /// SimGrid's actors need stacks.
  bool needs_stacks() const { return needs_stacks_; }
  /// Makes the coroutine of a process. It is resumed by callbacks and, after run(), only to unwind
  /// its stack.
  std::unique_ptr<Coroutine> make_coroutine(int processor, const std::string& name,
                                            Coroutine::Body body) {
    return carrier_->make_coroutine(processor, name, std::move(body));
  }

  Seconds now() const { return {events_.now()}; }
  /// Limit given to run() in simulated time; infinite before run().
  Seconds until() const { return {events_.until()}; }
  /// Schedules a callback at `date`, which must not be in the past. A callback never runs inside
  /// another.
  void at(Seconds date, auto then) { events_.at(date.value, then); }
  /// Schedules a callback before all callbacks of at() with the same date.
  void first_at(Seconds date, auto then) { events_.first_at(date.value, then); }
  /// Schedules a callback after those of first_at() and before those of at() with the same date.
  /// Callbacks of this function run by rank, lowest first.
  void ranked_at(Seconds date, std::uint64_t rank, auto then) {
    events_.ranked_at(date.value, rank, then);
  }
  /// Schedules a callback after all others with the same date.
  void last_at(Seconds date, auto then) { events_.last_at(date.value, then); }
  /// Schedules a callback to run directly after the present event, at the same date.
  void soon(auto then) { events_.soon(then); }
  /// Moves `bytes` (> 0) in an idle direction of a link. Calls `arrived` when they have arrived.
  void transfer(std::size_t direction, std::uint64_t bytes, Callback arrived) {
    carrier_->start(direction, bytes, arrived);
  }
  /// Number of bytes of a message left at `date`, see Carrier::left_of.
  double left_of(std::size_t direction, Seconds date) const {
    return carrier_->left_of(direction, date.value);
  }
  /// Cuts both directions of a link. Messages being moved never arrive, and no message may start
  /// afterwards.
  void cut(std::size_t direction) {
    carrier_->cut(direction);
    carrier_->cut(direction ^ 1);
  }

  /// From now on calls `pace` before the clock advances (see Pace). Throws InvariantBroken with
  /// SimGrid, whose clock cannot be delayed.
  void set_pace(Pace& pace);

  /// Runs until no event is left, the clock would pass `until`, or stop() or request_stop() is
  /// called. The clock stays at the last event or at `until`.
  End run(Seconds until);
  /// Marks the present event as one without effect. Such an event does not extend the run.
  void ignore_event() { events_.ignore(); }
  /// After a run: sets the clock back to the last event that had an effect.
  void rewind() { events_.rewind_to(events_.last_useful()); }
  /// Drops all pending events and ends the run.
  void stop() { events_.stop(End::stopped); }
  std::uint64_t handled() const { return events_.handled(); }  ///< number of handled events
  /// A number that grows with each event scheduled during the present event, see Events::asked().
  std::uint64_t asked() const { return events_.asked(); }

  // --- for class Parts and for links between two parts ------------------------------------------
  /// Processes that are computing and will reach a link between two parts after this computation.
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
