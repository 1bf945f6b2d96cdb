#pragma once
// What moves the messages over the links, and so drives the clock: SimGrid, or our own rules.
//
// A carrier knows the directions of links by numbers: those of a link are neighbours, the first
// even.
#include <cstdint>
#include <memory>
#include <string>

#include "simulator/machine/carriers/coroutine.hpp"
#include "simulator/machine/carriers/events.hpp"

namespace machine {

/// What the bodies of processes run on. Results are the same, byte by byte.
enum class Processes : std::uint8_t {
  fibers,  ///< stacks of ours, see make_fiber; several times faster
  actors,  ///< SimGrid's, each on the host of its processor
};

struct LinkRates {
  double one_way;    ///< bytes/s of a direction alone
  double both_ways;  ///< bytes/s of both directions together
};

class Carrier {
 public:
  virtual ~Carrier() = default;

  /// Builds the network; only before run(). Processors are numbered from 0 in order of creation.
  virtual void add_processor(const std::string& name) = 0;
  /// Returns the number of the direction from a to b. `rank` is the link's among all of the
  /// machine.
  virtual std::size_t add_link(int a, int b, LinkRates rates, std::size_t rank) = 0;
  virtual std::unique_ptr<Coroutine> make_coroutine(int processor, const std::string& name,
                                                    Coroutine::Body body) = 0;

  /// Moves `bytes` (> 0) over an idle direction, from now on, then handles `arrived`.
  virtual void start(std::size_t direction, std::uint64_t bytes, Callback arrived) = 0;
  /// The bytes still to be moved at `date`, if no message starts or ends on the link before; 0
  /// without a message.
  virtual double left_of(std::size_t direction, double date) const = 0;
  /// What moves in a direction never arrives. Nothing may move there any more.
  virtual void cut(std::size_t direction) = 0;
  /// Handles events and moves messages until neither is left, or the events are stopped.
  virtual void run() = 0;

  /// What the engines of a machine's parts do, see Parts: the next thing that happens; and all that
  /// happens before `bound`. Throw InvariantBroken if the carrier cannot.
  virtual Moment next() = 0;
  virtual void run_before(const Moment& bound) = 0;
};

/// SimGrid: processors are its hosts; a link is a SimGrid link that has the unidirectional rate for
/// one message and the bidirectional rate for two, which share it; a message is a communication.
/// Its engine is a process-wide singleton: one in the life of a host process.
std::unique_ptr<Carrier> make_simgrid(Events& events, Processes processes);

/// The same links by themselves: the end of a message follows from the two rates. One event a
/// message, any number of carriers in a host process; processes run on fibers.
std::unique_ptr<Carrier> make_direct(Events& events);

/// Version of the SimGrid that was linked: "3.32".
std::string simgrid_version();

}  // namespace machine
