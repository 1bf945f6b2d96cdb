#pragma once
// The simulated clock and the event queue, without messages on links.
#include <compare>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "simulator/machine/carriers/callback.hpp"

namespace machine {

/// Interface of a hook that is called before the clock advances. It may block, to pace the
/// simulation.
struct Pace {
  virtual ~Pace() = default;
  /// Returns true if the clock may advance to `date`, the date of the next event or NEVER. Returns
  /// false if events have been scheduled during the call; the hook is then called again.
  virtual bool before(double date) = 0;
};

/// Position of an event in the simulation's order: its date, then its order among events of the
/// same date. Ends of messages come after all other events of a date.
struct Moment {
  double date = std::numeric_limits<double>::infinity();
  std::uint64_t order = 0;  // first key among events of a date; Events::ENDS for ends of messages
  double since = 0;         // for the end of a message: the date at which it was predicted
  std::uint64_t rank = 0;   // rank of the link, for message ends predicted at the same date
  auto operator<=>(const Moment&) const = default;
};

/// Ends the simulation in this host process at its next event. Safe to call in a signal handler.
void request_stop();

class Events {
 public:
  static constexpr double NEVER = std::numeric_limits<double>::infinity();
  enum class End { no_event_left, until, stopped, requested };

  Events();
  ~Events();

  double now() const { return now_; }                  ///< in seconds
  double last_useful() const { return last_useful_; }  ///< date of the last event with an effect
  double until() const { return until_; }              ///< limit of simulated time
  void set_until(double date) { until_ = date; }

  /// Sets the hook that paces the clock. With a null pointer the clock advances freely.
  void set_pace(Pace* pace) { pace_ = pace; }
  Pace* pace() const { return pace_; }

  /// Schedules a callback at `date`, which must not be in the past. The order at one date is:
  /// callbacks of first_at(), of ranked_at() by rank, of at(), of last_at(). Callbacks of the same
  /// kind run in the order of scheduling.
  void at(double date, auto then) { new (ask(date, asked_++)) Callback(then); }
  void first_at(double date, auto then) { new (ask(date, asked_first_++)) Callback(then); }
  void ranked_at(double date, std::uint64_t rank, auto then) {
    new (ask(date, RANKED + rank)) Callback(then);
    ++asked_;
  }
  void last_at(double date, auto then) { new (ask(date, LAST + asked_++)) Callback(then); }
  /// Schedules a callback directly after the current event, at the same date.
  void soon(auto then) { soon_.emplace_back(then); }

  // First order numbers of ranked events, of usual events, of last_at() and of message ends. Lower
  // numbers belong to first_at().
  static constexpr std::uint64_t RANKED = std::uint64_t{1} << 37, USUAL = std::uint64_t{1} << 38,
                                 LAST = std::uint64_t{1} << 39, ENDS = std::uint64_t{1} << 40;

  /// The date of the next event; NEVER if the queue is empty.
  double next() const { return next_; }
  /// Date and order of the next event. Equals the present moment if callbacks of soon() are pending
  /// between events.
  Moment next_moment() const;
  /// Runs callbacks of soon() that are pending between events.
  void finish();
  /// Removes the next event from the queue, which must not be empty, and handles it at its date.
  void handle_next();
  /// Advances the clock to `date`; no effect if `date` is in the past.
  void advance(double date) { now_ = date > now_ ? date : now_; }
  /// Handles an event now, including its callbacks of soon(). Stops the run instead if the time
  /// limit has passed or request_stop() has been called.
  void handle(Callback callback);

  /// Marks the current event as one without effect, so that it does not extend the run.
  void ignore() { ignored_ = true; }
  /// Sets the clock back to `date`.
  void rewind_to(double date) { now_ = date; }
  /// Ends the run and drops all pending callbacks. After several calls, end() returns the reason
  /// given first.
  void stop(End why);
  bool stopped() const { return stopped_; }
  End end() const { return end_; }

  std::uint64_t handled() const { return handled_; }
  /// Counter that grows with each event scheduled during the current event.
  std::uint64_t asked() const { return asked_ + soon_.size(); }

 private:
  // Defined in the source file, because Boost.Heap compiles slowly and many files include this
  // header.
  struct Heap;
  // Makes room for a callback and returns its address. The caller constructs the callback there,
  // because copying an object just written would stall the host's processor.
  Callback* ask(double date, std::uint64_t order);

  double now_ = 0, until_ = NEVER, last_useful_ = 0;
  double next_ = NEVER;  // date on top of the heap, cached because every event reads it
  std::unique_ptr<Heap> heap_;
  std::vector<Callback> callbacks_;  // stored outside the heap, which moves its elements often
  std::vector<std::uint32_t> free_;  // unused indices of callbacks_
  std::vector<Callback> soon_;
  std::uint64_t asked_first_ = 0, asked_ = USUAL, handled_ = 0;
  Pace* pace_ = nullptr;
  bool stopped_ = false, ignored_ = false;
  End end_ = End::no_event_left;
};

}  // namespace machine
