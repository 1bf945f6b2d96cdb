#pragma once
// The simulated clock and the event queue, without the messages on links.
#include <compare>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "simulator/machine/carriers/callback.hpp"

namespace machine {

/// Hook called before each advance of the clock; it may block, to pace the simulation.
struct Pace {
  virtual ~Pace() = default;
  /// `date` is that of the next event, or NEVER. Returns whether the clock may advance; false if
  /// another event after now has been scheduled meanwhile. It is then called again.
  virtual bool before(double date) = 0;
};

/// Date of an event, and its order among those of the same date. Messages end after all events.
struct Moment {
  double date = std::numeric_limits<double>::infinity();
  std::uint64_t order = 0;  // of an event; Events::ENDS for the end of a message
  double since = 0;         // of a message's end: date of its prediction
  std::uint64_t rank = 0;   // of ends predicted together: rank of the link
  auto operator<=>(const Moment&) const = default;
};

/// Ends the simulation in this host process at its next event. Signal handlers may call it.
void request_stop();

class Events {
 public:
  static constexpr double NEVER = std::numeric_limits<double>::infinity();
  enum class End { no_event_left, until, stopped, requested };

  Events();
  ~Events();

  double now() const { return now_; }                  ///< seconds
  double last_useful() const { return last_useful_; }  ///< date of the last event not ignored
  double until() const { return until_; }              ///< end of simulated time
  void set_until(double date) { until_ = date; }

  /// Null: the clock advances freely.
  void set_pace(Pace* pace) { pace_ = pace; }
  Pace* pace() const { return pace_; }

  /// Schedules a callback at `date`, not before now. Callbacks of one date come in this order:
  /// those of first_at(), of ranked_at() by rank, of at(), and of last_at(). Otherwise the order is
  /// that of scheduling.
  void at(double date, auto then) { new (ask(date, asked_++)) Callback(then); }
  void first_at(double date, auto then) { new (ask(date, asked_first_++)) Callback(then); }
  void ranked_at(double date, std::uint64_t rank, auto then) {
    new (ask(date, RANKED + rank)) Callback(then);
    ++asked_;
  }
  void last_at(double date, auto then) { new (ask(date, LAST + asked_++)) Callback(then); }
  /// Schedules a callback right after the current event, at the same instant.
  void soon(auto then) { soon_.emplace_back(then); }

  // Starts of the orders of ranked events, of usual ones, of the last ones and of messages' ends.
  // Lower orders are those of first_at().
  static constexpr std::uint64_t RANKED = std::uint64_t{1} << 37, USUAL = std::uint64_t{1} << 38,
                                 LAST = std::uint64_t{1} << 39, ENDS = std::uint64_t{1} << 40;

  /// The date of the next event; NEVER if there is none.
  double next() const { return next_; }
  /// The same with its order; now, if callbacks of soon() are pending between events.
  Moment next_moment() const;
  /// Calls the callbacks of soon() that are pending between events.
  void finish();
  /// Takes the next event, which must exist, and advances the clock to its date.
  void handle_next();
  /// Advances the clock to `date`, unless it is there already.
  void advance(double date) { now_ = date > now_ ? date : now_; }
  /// Handles an event now: calls it and its callbacks of soon(). Stops instead if the time is up or
  /// after request_stop().
  void handle(Callback callback);

  /// Marks the current event as without effect: it does not extend the run.
  void ignore() { ignored_ = true; }
  /// Sets the clock back.
  void rewind_to(double date) { now_ = date; }
  /// Ends all callbacks. The first reason counts.
  void stop(End why);
  bool stopped() const { return stopped_; }
  End end() const { return end_; }

  std::uint64_t handled() const { return handled_; }
  /// Counter that grows with each event scheduled during the current event.
  std::uint64_t asked() const { return asked_ + soon_.size(); }

 private:
  struct Heap;  // defined in the source: its library compiles slowly, and machines include this
  // Returns the address for the callback, which is constructed in place: a copy of data just
  // written would stall the host.
  Callback* ask(double date, std::uint64_t order);

  double now_ = 0, until_ = NEVER, last_useful_ = 0;
  double next_ = NEVER;  // the heap's next date, read at every event
  std::unique_ptr<Heap> heap_;
  std::vector<Callback> callbacks_;  // of the heap's events, which the heap moves often
  std::vector<std::uint32_t> free_;  // free places in callbacks_
  std::vector<Callback> soon_;
  std::uint64_t asked_first_ = 0, asked_ = USUAL, handled_ = 0;
  Pace* pace_ = nullptr;
  bool stopped_ = false, ignored_ = false;
  End end_ = End::no_event_left;
};

}  // namespace machine
