#pragma once
// The simulated clock and the queue of events. Messages on links are not among these events.
#include <compare>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "simulator/machine/carriers/callback.hpp"

namespace machine {

/// Interface of a function that is called before the clock advances. The function may block, to
/// slow the simulation down.
struct Pace {
  virtual ~Pace() = default;
  /// Returns true if the clock may advance to `date`, which is the date of the next event or NEVER.
  /// Returns false if events were scheduled during the call; the function is then called again.
  virtual bool before(double date) = 0;
};

/// Position of an event in the simulation: its date in seconds, then its order among events of that
/// date. Ends of messages come after all other events of a date.
struct Moment {
  double date = std::numeric_limits<double>::infinity();
  std::uint64_t order = 0;  // order among events of a date; Events::ENDS for all ends of messages
  double since = 0;         // for the end of a message: the date in s at which it was predicted
  // Resolves ties between ends predicted at the same date; lower comes first.
  std::uint64_t rank = 0;
  auto operator<=>(const Moment&) const = default;
};

/// Ends the simulation of this host process before its next event. Safe to call in a signal
/// handler.
void request_stop();

class Events {
 public:
  static constexpr double NEVER = std::numeric_limits<double>::infinity();
  enum class End { no_event_left, until, stopped, requested };

  Events();
  ~Events();

  double now() const { return now_; }  ///< simulated time in seconds
  /// Date in s of the last event that had an effect.
  double last_useful() const { return last_useful_; }
  double until() const { return until_; }  ///< limit of simulated time in seconds
  void set_until(double date) { until_ = date; }

  /// Sets the function that delays the clock. With a null pointer the clock advances freely.
  void set_pace(Pace* pace) { pace_ = pace; }
  Pace* pace() const { return pace_; }

  /// The next four functions schedule a callback at `date`, which must not be in the past. At one
  /// date, callbacks of first_at() come first, then those of ranked_at() by rank, then at(), then
  /// last_at(). Within each of these groups, callbacks run in the order of scheduling.
  void at(double date, auto then) { new (ask(date, asked_++)) Callback(then); }
  void first_at(double date, auto then) { new (ask(date, asked_first_++)) Callback(then); }
  void ranked_at(double date, std::uint64_t rank, auto then) {
    new (ask(date, RANKED + rank)) Callback(then);
    ++asked_;
  }
  void last_at(double date, auto then) { new (ask(date, LAST + asked_++)) Callback(then); }
  /// Schedules a callback to run directly after the present event, at the same date.
  void soon(auto then) { soon_.emplace_back(then); }

  // The lowest order numbers of ranked_at(), at(), last_at() and ends of messages. Numbers below
  // RANKED are those of first_at().
  static constexpr std::uint64_t RANKED = std::uint64_t{1} << 37, USUAL = std::uint64_t{1} << 38,
                                 LAST = std::uint64_t{1} << 39, ENDS = std::uint64_t{1} << 40;

  /// Date of the next event in seconds; NEVER if the queue is empty.
  double next() const { return next_; }
  /// Date and order of the next event. If callbacks of soon() are still to run, the date is the
  /// present one.
  Moment next_moment() const;
  /// Runs the callbacks of soon() that were scheduled outside of an event.
  void finish();
  /// Removes the next event from the queue, which must not be empty, and handles it at its date.
  void handle_next();
  /// Advances the clock to `date`. Has no effect if `date` is in the past.
  void advance(double date) { now_ = date > now_ ? date : now_; }
  /// Handles an event now, then the callbacks that it scheduled by soon(). If the time limit has
  /// passed or request_stop() has been called, stops the run instead.
  void handle(Callback callback);

  /// Marks the present event as one without effect. Such an event does not extend the run.
  void ignore() { ignored_ = true; }
  /// Sets the clock back to `date`.
  void rewind_to(double date) { now_ = date; }
  /// Ends the run and drops all pending callbacks. If stop() is called several times, end() returns
  /// the reason of the first call.
  void stop(End why);
  bool stopped() const { return stopped_; }
  End end() const { return end_; }

  std::uint64_t handled() const { return handled_; }
  /// A number that grows with each event scheduled during the present event, so that a caller can
  /// find out whether something was scheduled.
  std::uint64_t asked() const { return asked_ + soon_.size(); }

 private:
  // Defined in events.cpp, because Boost.Heap compiles slowly and many files include this header.
  struct Heap;
  // Makes room for a callback and returns the address where the caller constructs the callback.
  // Constructing it elsewhere and copying it would stall the host's processor.
  Callback* ask(double date, std::uint64_t order);

  double now_ = 0, until_ = NEVER, last_useful_ = 0;
  double next_ = NEVER;  // date on top of the heap, kept here because every event reads it
  std::unique_ptr<Heap> heap_;
  std::vector<Callback> callbacks_;  // outside the heap, which moves its elements often
  std::vector<std::uint32_t> free_;  // indices of unused elements of callbacks_
  std::vector<Callback> soon_;
  std::uint64_t asked_first_ = 0, asked_ = USUAL, handled_ = 0;
  Pace* pace_ = nullptr;
  bool stopped_ = false, ignored_ = false;
  End end_ = End::no_event_left;
};

}  // namespace machine
