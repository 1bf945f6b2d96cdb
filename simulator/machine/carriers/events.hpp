#pragma once
// The simulated clock and the events that are asked for, without the messages on links.
#include <compare>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "simulator/machine/carriers/callback.hpp"

namespace machine {

/// Is asked each time before the clock goes on, and may take its time.
struct Pace {
  virtual ~Pace() = default;
  /// The next thing happens at `date`; NEVER: nothing does. Returns whether the clock may go on;
  /// false if something else has been asked for meanwhile, for a date after now, and it is to be
  /// asked again.
  virtual bool before(double date) = 0;
};

/// When something happens, and its place among all that happens at that date. Messages end after
/// all events.
struct Moment {
  double date = std::numeric_limits<double>::infinity();
  std::uint64_t order = 0;  // of an event; Events::ENDS for the end of a message
  double since = 0;         // of ends: when they were foreseen
  std::uint64_t rank = 0;   // of ends that were foreseen together: that of their link
  auto operator<=>(const Moment&) const = default;
};

/// Ends the simulation of this host process at its next event. May be called by a signal handler.
void request_stop();

class Events {
 public:
  static constexpr double NEVER = std::numeric_limits<double>::infinity();
  enum class End { no_event_left, until, stopped, requested };

  Events();
  ~Events();

  double now() const { return now_; }                  ///< seconds
  double last_useful() const { return last_useful_; }  ///< the last event that was of use
  double until() const { return until_; }              ///< the end of simulated time
  void set_until(double date) { until_ = date; }

  /// Null: nobody is asked.
  void set_pace(Pace* pace) { pace_ = pace; }
  Pace* pace() const { return pace_; }

  /// Asks for a callback at `date`, not before now. Those of one date come in the order they were
  /// asked for. First come those of first_at(), then those that have a rank, in the order of ranks;
  /// those of last_at() come after all others.
  void at(double date, auto then) { new (ask(date, asked_++)) Callback(then); }
  void first_at(double date, auto then) { new (ask(date, asked_first_++)) Callback(then); }
  void ranked_at(double date, std::uint64_t rank, auto then) {
    new (ask(date, RANKED + rank)) Callback(then);
    ++asked_;
  }
  void last_at(double date, auto then) { new (ask(date, LAST + asked_++)) Callback(then); }
  /// Asks for a callback when the event being handled is over, at the same instant.
  void soon(auto then) { soon_.emplace_back(then); }

  // Where those that have ranks come at a date, those that have none, the last, and the ends of
  // messages. Orders below are asked for as first.
  static constexpr std::uint64_t RANKED = std::uint64_t{1} << 37, USUAL = std::uint64_t{1} << 38,
                                 LAST = std::uint64_t{1} << 39, ENDS = std::uint64_t{1} << 40;

  /// The date of the next event; NEVER if there is none.
  double next() const { return next_; }
  /// The same; now, if something has been asked for soon while no event was handled.
  Moment next_moment() const;
  /// Calls what has been asked for soon while no event was handled.
  void finish();
  /// Takes the next event, which there must be: the clock comes to its date.
  void handle_next();
  /// The clock goes on to `date`, unless it is there already.
  void advance(double date) { now_ = date > now_ ? date : now_; }
  /// An event now: calls it, and what it asks for soon. If the time is up, or a signal handler has
  /// asked for the end, it stops instead.
  void handle(Callback callback);

  /// The event being handled is of no use: the clock does not stay at it when the run ends.
  void ignore() { ignored_ = true; }
  /// The clock goes back.
  void rewind_to(double date) { now_ = date; }
  /// Nothing is called any more. The first reason counts.
  void stop(End why);
  bool stopped() const { return stopped_; }
  End end() const { return end_; }

  std::uint64_t handled() const { return handled_; }
  /// Grows with every event that is asked for, while one is handled.
  std::uint64_t asked() const { return asked_ + soon_.size(); }

 private:
  struct Heap;  // its library takes long to compile, and machines include this
  // Returns where the callback is to be. (It is made there: to copy what has just been written
  // makes the host wait.)
  Callback* ask(double date, std::uint64_t order);

  double now_ = 0, until_ = NEVER, last_useful_ = 0;
  double next_ = NEVER;  // the heap's next date, which is asked for at every event
  std::unique_ptr<Heap> heap_;
  std::vector<Callback> callbacks_;  // of the events in the heap, which moves them often
  std::vector<std::uint32_t> free_;  // places
  std::vector<Callback> soon_;
  std::uint64_t asked_first_ = 0, asked_ = USUAL, handled_ = 0;
  Pace* pace_ = nullptr;
  bool stopped_ = false, ignored_ = false;
  End end_ = End::no_event_left;
};

}  // namespace machine
