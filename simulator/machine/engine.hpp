#pragma once
// The simulated clock, its events, and the wires: the one door to SimGrid.
//
// Processors are SimGrid hosts; a transputer link is a SimGrid link that has the unidirectional
// rate for one message and the bidirectional rate for two, which share it. A message on a link is a
// SimGrid communication. Processor time is arbitrated by our own scheduler (SimGrid
// has no two-priority processor), which needs only a clock and events at a date.
//
// SimGrid's engine is a process-wide singleton: one Engine in the life of a host process.
#include <cstdint>
#include <memory>
#include <new>
#include <string>
#include <type_traits>

#include "simulator/machine/coroutine.hpp"
#include "simulator/machine/units.hpp"

namespace machine {

/// Version of the SimGrid that was linked: "3.32".
std::string simgrid_version();

/// What to do at an event: a small function object, copied as plain bytes (std::function costs an
/// allocation or a call to move, millions of times).
class Callback {
 public:
  Callback() = default;
  template <class Body>
  requires(!std::is_same_v<Body, Callback>) Callback(Body body)
      : call_([](void* at) { (*static_cast<Body*>(at))(); }) {
    static_assert(sizeof(Body) <= sizeof body_ && std::is_trivially_copyable_v<Body>);
    new (body_) Body(body);
  }
  void operator()() { call_(body_); }

 private:
  void (*call_)(void*) = nullptr;
  alignas(8) unsigned char body_[24];
};

/// What the bodies of processes run on. Results are the same, byte by byte.
enum class Processes : std::uint8_t {
  fibers,  ///< stacks of ours, see make_fiber; several times faster
  actors,  ///< SimGrid's, each on the host of its processor
};

/// Ends the simulation of this host process at its next event. May be called by a signal handler.
void request_stop();

class Engine {
 public:
  using Callback = machine::Callback;
  struct LinkRates {
    double one_way;    ///< bytes/s of a direction alone
    double both_ways;  ///< bytes/s of both directions together
  };

  explicit Engine(Processes processes = Processes::fibers);
  ~Engine();
  Engine(const Engine&) = delete;
  Engine& operator=(const Engine&) = delete;

  /// Builds the platform; only before run(). Processors are numbered from 0 in order of creation.
  int add_processor(const std::string& name);
  void add_link(int a, int b, LinkRates rates);
  /// A process's body, to be resumed by callbacks and, once it is to end, after run().
  std::unique_ptr<Coroutine> make_coroutine(int processor, const std::string& name,
                                            Coroutine::Body body);

  Seconds now() const;
  Seconds until() const;  ///< the limit given to run(); infinity before
  /// Calls back at simulated time `date` (not before now). Callbacks never nest.
  void at(Seconds date, Callback callback);
  /// The same, before all that at() has asked for at that instant.
  void first_at(Seconds date, Callback callback);
  /// Calls back when the event being handled is over, at the same simulated instant.
  void soon(Callback callback);
  /// Moves `bytes` (> 0) over the link from one processor to its neighbour, then calls back. One
  /// message at a time in each direction.
  void transfer(int from, int to, std::uint64_t bytes, Callback arrived);
  /// What moves over the link, in both directions, never arrives. Nothing may move there any more.
  void cut(int a, int b);

  /// Runs until no event is left, until the clock would pass `until`, or until stop() or
  /// request_stop(). The clock stays at the last event, or at `until`.
  enum class End { no_event_left, until, stopped, requested };
  End run(Seconds until);
  /// Called by an event that turns out to be of no use any more: the clock does not stay at it when
  /// the run ends.
  void ignore_event();
  /// After a run: the clock goes back to the last event that was of use.
  void rewind();
  /// Drops all events still to come.
  void stop();
  std::uint64_t handled() const;  ///< events
  std::uint64_t asked() const;  ///< grows with every event that is asked for, while one is handled

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace machine
